// Makes the database of a new study, whole or not at all, and the rows that never change.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "database/sqlite_connection.h"
#include "database/study_store.h"

namespace database {

/// Writes study.db with all facts, slots and trial lists under another name, syncs it and renames it. The caller holds the
/// write lock. Throws environmentFault on disk faults.
void createDatabase(const StudyFolder& folder, const StudyFacts& facts,
                    const std::vector<std::vector<protocols::BlindedTrial>>& slots,
                    const std::map<protocols::FileCode, std::string>& stimulusHashes);

/// Writes study.db with an empty schema that `fill` fills in the same transaction, under another name, syncs it and renames it.
void makeDatabase(const StudyFolder& folder, const std::function<void(const SqliteConnection&)>& fill);

/// Fills the tables of a new schema whose rows never change, in the caller's transaction.
void insertFixedRows(const SqliteConnection& sqlite, const StudyFacts& facts,
                     const std::vector<std::vector<protocols::BlindedTrial>>& slots,
                     const std::map<protocols::FileCode, std::string>& stimulusHashes);

}  // namespace database
