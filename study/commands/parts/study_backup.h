// The work of `vis2hap backup`, also for the tools page of the window.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "database/study_store.h"

namespace study::commands {

struct Backup {
    std::vector<std::string> faults;
    database::LogHead head;   ///< of the copy
    std::size_t answers = 0;  ///< in the copy
};

/// Packs a copy of the whole study into the new tar file `out`, also while a session runs. Throws badInput where the file exists
/// or would lie in the study, environmentFault where there is no room; no half-written file is left. The faults have one line for
/// each fault of the key files, which the backup holds as they are, for each link and each special file, which it leaves out, and
/// for each rescue file of a study from which something was erased.
Backup writeBackup(const database::StudyStore& store, const std::filesystem::path& out);

}  // namespace study::commands
