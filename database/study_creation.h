// Makes the database of a new study, whole or not at all.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "database/study_store.h"

namespace database {

/// Writes study.db with all facts, slots and trial lists under another name, syncs it and renames it. The caller holds the
/// write lock. Throws environmentFault on disk faults.
void createDatabase(const StudyFolder& folder, const StudyFacts& facts,
                    const std::vector<std::vector<protocols::BlindedTrial>>& slots,
                    const std::map<protocols::FileCode, std::string>& stimulusHashes);

}  // namespace database
