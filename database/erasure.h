// Removes what is known about a participant without breaking the log: an erased entry keeps its hash and its place in the
// chain, and the recorded act names the participant whose earlier entries were emptied.
#pragma once

#include "database/sqlite_connection.h"
#include "database/study_store.h"

namespace database {

/// As StudyStore::erase.
void eraseFrom(const SqliteConnection& sqlite, const Erasure& erasure);

}  // namespace database
