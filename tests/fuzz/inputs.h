// What readers of files need around their input.
#pragma once

#include <filesystem>
#include <fstream>
#include <optional>
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

/// What a reader has to compress, seal or hash by itself before it reads it: the input behind a first sign "+". A checksum or a
/// seal refuses every other change, so that nothing behind it would be reached. Empty for an input that is read as it is.
inline std::optional<std::string> contentToPack(const std::string& input)
{
    return input.starts_with('+') ? std::optional(input.substr(1)) : std::nullopt;
}

}  // namespace fuzz
