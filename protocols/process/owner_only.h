// New files and folders that other accounts cannot open. A process that handles a study makes all of its own so.
#pragma once

#include <filesystem>

namespace protocols {

/// From now on new files get mode 0600 and new folders 0700, for the rest of the process.
void keepFilesToOwner();
bool filesAreKeptToOwner();

/// Takes the rights of others off a folder, and the default ACL that would give new files in it rights which no umask removes.
/// Where the file system has neither, nothing changes: `verify` says so.
void closeFolderToOthers(const std::filesystem::path& folder);

}  // namespace protocols
