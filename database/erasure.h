// Removes what is stored about a participant: facts and debriefing, or every answer and note too, from the tables, the log, the
// write-ahead log and the free pages of the file. The hashes stay, so that the rest can be verified.
#pragma once

#include <string>
#include <vector>

#include "database/sqlite_connection.h"
#include "database/study_store.h"

namespace database {

/// As StudyStore::erase.
ErasureRecord eraseFrom(const SqliteConnection& sqlite, const Erasure& erasure);

}  // namespace database
