// Checks a whole study for `vis2hap verify`: database and hash chain, keys, stimuli and protocol.
#pragma once

#include <string>
#include <vector>

#include "database/study_store.h"

namespace study::records {

/// One line a fault; empty for a study without faults.
std::vector<std::string> faultsOf(const database::StudyStore& store);

}  // namespace study::records
