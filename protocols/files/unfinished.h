// Names of files and folders that are still being made. They are hidden, beside their place, and hold the computer's name and
// the number of the process. So two programs never write into the same one, not even on a shared disk.
#pragma once

#include <filesystem>

namespace protocols {

/// ".NAME.unfinished-COMPUTER-PID" beside the place.
std::filesystem::path unfinishedName(const std::filesystem::path& place);

/// Removes what killed processes of this computer left unfinished for this place.
void removeAbandoned(const std::filesystem::path& place);

}  // namespace protocols
