// What readers of files need around their input.
#pragma once

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

namespace fuzz {

inline void put(const std::filesystem::path& file, const std::string& bytes)
{
    std::ofstream(file, std::ios::binary | std::ios::trunc) << bytes;
}

/// A false claim is a fault of the reader.
inline void require(bool isSo, const char* fault)
{
    if (!isSo) throw std::runtime_error(fault);
}

}  // namespace fuzz
