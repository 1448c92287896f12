// Waiting until bytes and names have reached the disk. The parts of the writers in whole_file.h and folder_draft.h.
#pragma once

#include <filesystem>

namespace protocols {

/// The bytes of a file. Throws environmentFault.
void syncFile(const std::filesystem::path& file);

/// The names in a folder: new, renamed and removed ones. Throws environmentFault.
void syncFolder(const std::filesystem::path& folder);

/// Every file and folder at and below `folder`; one call to the file system where there are many. Throws environmentFault.
void syncTree(const std::filesystem::path& folder);

}  // namespace protocols
