// Files read and written in one piece: a reader gets all bytes or a named fault; a writer leaves
// either the whole new file or what was there before.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace rendering {

/// All bytes. Throws badInput where the file is missing, a folder, or cannot be read.
std::string readWholeFile(const std::filesystem::path& file);

/// Writes beside the file under a temporary name, then renames. Throws environmentFault; the temporary is gone then.
void writeWholeFile(const std::filesystem::path& file, std::string_view bytes);

}  // namespace rendering
