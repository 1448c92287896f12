// Puts NaN into a torch archive (a zip file of stored entries) and corrects its checksums. Only a check of the
// numbers themselves can find the fault.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace support {

inline std::uint32_t crc32(const std::string& bytes)
{
    std::uint32_t crc = 0xFFFFFFFFU;
    for (const char byte : bytes) {
        crc ^= static_cast<unsigned char>(byte);
        for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1U) ^ ((crc & 1U) != 0 ? 0xEDB88320U : 0U);
    }
    return ~crc;
}

inline std::uint32_t numberAt(const std::string& bytes, std::size_t at, int width)
{
    std::uint32_t number = 0;
    for (int i = width - 1; i >= 0; --i)
        number = number << 8U | static_cast<unsigned char>(bytes[at + static_cast<std::size_t>(i)]);
    return number;
}

inline void putCrc(std::string& bytes, std::size_t at, std::uint32_t crc)
{
    for (unsigned i = 0; i < 4; ++i) bytes[at + i] = static_cast<char>(crc >> (8 * i) & 0xFFU);
}

/// Fills every tensor of at least 1000 bytes with `number`, the bytes of one NaN.
inline std::string withNumbersSpoilt(std::string bytes, const std::string& number)
{
    const std::string entryMark("PK\x01\x02", 4);
    for (std::size_t at = bytes.find(entryMark); at != std::string::npos; at = bytes.find(entryMark, at + 4)) {
        const std::size_t size = numberAt(bytes, at + 24, 4), nameLength = numberAt(bytes, at + 28, 2);
        const std::size_t local = numberAt(bytes, at + 42, 4);
        if (bytes.substr(at + 46, nameLength).find("/data/") == std::string::npos || size < 1000) continue;
        const std::size_t data = local + 30 + numberAt(bytes, local + 26, 2) + numberAt(bytes, local + 28, 2);
        for (std::size_t i = 0; i + number.size() <= size; i += number.size()) bytes.replace(data + i, number.size(), number);
        const std::uint32_t crc = crc32(bytes.substr(data, size));
        putCrc(bytes, at + 16, crc);
        putCrc(bytes, local + 14, crc);
        if (bytes.compare(data + size, 4, std::string("PK\x07\x08", 4)) == 0) putCrc(bytes, data + size + 4, crc);
    }
    return bytes;
}

}  // namespace support
