// Overwrites numbers in a file of plain tensors (tensor_file.h). Only a check of the numbers themselves can find the fault.
#pragma once

#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string>

namespace support {

/// Fills every tensor of this kind ("F16") and of at least 1000 bytes with `number`, the bytes of one number.
inline std::string withNumbersSpoilt(std::string bytes, const std::string& kind, const std::string& number)
{
    std::uint64_t length = 0;
    std::memcpy(&length, bytes.data(), 8);
    const auto header = nlohmann::json::parse(bytes.substr(8, length));
    for (const auto& entry : header) {
        if (!entry.contains("dtype") || entry["dtype"] != kind) continue;
        const auto begin = entry["data_offsets"][0].get<std::size_t>(), end = entry["data_offsets"][1].get<std::size_t>();
        if (end - begin < 1000) continue;
        for (std::size_t at = 8 + length + begin; at < 8 + length + end; at += number.size())
            bytes.replace(at, number.size(), number);
    }
    return bytes;
}

}  // namespace support
