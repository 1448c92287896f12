// SHA-256 (FIPS 180-4) in lower-case hexadecimal, computed by libgcrypt, which uses the processor's instructions for it.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace protocols {

std::string sha256(std::string_view bytes);

/// Reads the file in blocks, so that it may be larger than the memory. Throws badInput where it cannot be read.
std::string sha256OfFile(const std::filesystem::path& file);

}  // namespace protocols
