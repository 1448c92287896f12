// SHA-256 (FIPS 180-4), by libmd, which every Debian system has. Lower-case hexadecimal.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace protocols {

std::string sha256(std::string_view bytes);

/// Throws badInput where the file cannot be read.
std::string sha256OfFile(const std::filesystem::path& file);

}  // namespace protocols
