// Names of files and folders that are still being made: hidden, beside their place, with the number of the
// process, so that two programs never write into one.
#pragma once

#include <filesystem>

namespace protocols {

/// ".NAME.unfinished-PID" beside the place.
std::filesystem::path unfinishedName(const std::filesystem::path& place);

/// Removes what killed processes left unfinished for this place.
void removeAbandoned(const std::filesystem::path& place);

}  // namespace protocols
