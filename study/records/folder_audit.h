// The files of a study folder, for `vis2hap verify`: strays, links in place of files, and modes that let others read.
#pragma once

#include <string>
#include <vector>

#include "database/study_store.h"

namespace study::records {

struct FolderFindings {
    std::vector<std::string> faults;                  ///< unknown files, links, and things that are no files
    std::vector<std::string> notes;                   ///< files that other users may read; some file systems have no modes
    std::vector<std::filesystem::path> unknownFiles;  ///< what does not belong to the study, relative to its folder
    bool isReadable = true;  ///< false: a pipe or a folder stands in the place of a file, so reading could wait for ever
};

FolderFindings findingsInFolder(const database::StudyStore& store);

}  // namespace study::records
