#include "tests/fuzz/made_png.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <stdexcept>

namespace fuzz {

namespace {

constexpr std::size_t headerBytes = 13, nameBytes = 4;
constexpr std::uint32_t width = 9, height = 7;
constexpr int grey = 0, colour = 2, palette = 3, greyAlpha = 4, colourAlpha = 6;

std::string bigEndian(std::uint32_t value, int size)
{
    std::string bytes;
    for (int i = size - 1; i >= 0; --i) bytes += static_cast<char>(value >> 8 * i & 0xff);
    return bytes;
}

std::string compressed(std::string_view rows)
{
    uLongf size = compressBound(static_cast<uLong>(rows.size()));
    std::string bytes(size, '\0');
    const auto* from = reinterpret_cast<const Bytef*>(rows.data());
    if (compress2(reinterpret_cast<Bytef*>(bytes.data()), &size, from, static_cast<uLong>(rows.size()), 1) != Z_OK)
        throw std::runtime_error("the rows of an image cannot be compressed");
    bytes.resize(size);
    return bytes;
}

std::string chunk(std::string_view name, std::string_view body)
{
    const std::string checked = std::string(name) + std::string(body);
    const auto sum = crc32(0, reinterpret_cast<const Bytef*>(checked.data()), static_cast<uInt>(checked.size()));
    return bigEndian(static_cast<std::uint32_t>(body.size()), 4) + checked + bigEndian(static_cast<std::uint32_t>(sum), 4);
}

/// What pngOf() takes for a chunk.
std::string part(std::string_view name, std::string_view body)
{
    return std::string(name) + bigEndian(static_cast<std::uint32_t>(body.size()), 2) + std::string(body);
}

int channelsOf(int kind) { return kind == colour ? 3 : kind == greyAlpha ? 2 : kind == colourAlpha ? 4 : 1; }

/// Rows with each of the five filters in turn.
void addRows(std::string& rows, std::uint32_t columns, std::uint32_t count, int bitsOfPixel, int kind)
{
    const std::size_t bytes = (columns * static_cast<std::size_t>(bitsOfPixel) + 7) / 8;
    for (std::uint32_t row = 0; columns > 0 && row < count; ++row) {
        rows += static_cast<char>(kind == palette ? 0 : row % 5);
        for (std::size_t i = 0; i < bytes; ++i) rows += static_cast<char>(kind == palette ? i % 16 : i * 37 + row * 11);
    }
}

std::string rowsOf(int kind, int bits, bool isInterlaced)
{
    struct Pass {
        std::uint32_t x, y, stepX, stepY;
    };
    static constexpr std::array<Pass, 7> passes{
        {{0, 0, 8, 8}, {4, 0, 8, 8}, {0, 4, 4, 8}, {2, 0, 4, 4}, {0, 2, 2, 4}, {1, 0, 2, 2}, {0, 1, 1, 2}}};
    std::string rows;
    const int bitsOfPixel = bits * channelsOf(kind);
    if (!isInterlaced) {
        addRows(rows, width, height, bitsOfPixel, kind);
        return rows;
    }
    for (const Pass& pass : passes)
        addRows(rows, (width - pass.x + pass.stepX - 1) / pass.stepX, (height - pass.y + pass.stepY - 1) / pass.stepY,
                bitsOfPixel, kind);
    return rows;
}

/// `between`: chunks between header and rows.
std::string partsOf(int kind, int bits, bool isInterlaced, const std::string& between = {})
{
    const std::string header = bigEndian(width, 4) + bigEndian(height, 4) + static_cast<char>(bits) + static_cast<char>(kind) +
                               std::string(2, '\0') + static_cast<char>(isInterlaced);
    std::string colours;
    if (kind == palette)
        for (int i = 0; i < 3 << (bits < 4 ? bits : 4); ++i) colours += static_cast<char>(i * 5);
    return header + (colours.empty() ? "" : part("PLTE", colours)) + between + part("IDAT", rowsOf(kind, bits, isInterlaced));
}

/// Exif data of one tag, in the order of bytes of Motorola or of Intel.
std::string orientationMark(int orientation, bool isMotorola)
{
    const auto number = [&](std::uint32_t value, int size) {
        const std::string bytes = bigEndian(value, size);
        return isMotorola ? bytes : std::string(bytes.rbegin(), bytes.rend());
    };
    return (isMotorola ? "MM" : "II") + number(42, 2) + number(8, 4) + number(1, 2) + number(0x0112, 2) + number(3, 2) +
           number(1, 4) + number(static_cast<std::uint32_t>(orientation), 2) + number(0, 2) + number(0, 4);
}

}  // namespace

std::string pngOf(std::string_view parts)
{
    std::string file = "\x89PNG\r\n\x1a\n" + chunk("IHDR", parts.substr(0, headerBytes));
    parts.remove_prefix(std::min(headerBytes, parts.size()));
    while (parts.size() >= nameBytes + 2) {
        const std::string_view name = parts.substr(0, nameBytes);
        const auto byte = [&](std::size_t at) { return static_cast<std::size_t>(static_cast<unsigned char>(parts[at])); };
        const std::string_view body = parts.substr(nameBytes + 2, byte(nameBytes) << 8 | byte(nameBytes + 1));
        file += chunk(name, name == "IDAT" ? compressed(body) : std::string(body));
        parts.remove_prefix(nameBytes + 2 + body.size());
    }
    return file + chunk("IEND", "");
}

std::vector<std::string> partsOfPngs()
{
    std::vector<std::string> all;
    for (const bool isInterlaced : {false, true}) {
        for (const int bits : {1, 2, 4, 8, 16}) all.push_back(partsOf(grey, bits, isInterlaced));
        for (const int bits : {1, 2, 4, 8}) all.push_back(partsOf(palette, bits, isInterlaced));
        for (const int kind : {colour, greyAlpha, colourAlpha})
            for (const int bits : {8, 16}) all.push_back(partsOf(kind, bits, isInterlaced));
    }
    all.push_back(partsOf(grey, 4, false, part("tRNS", std::string("\0\3", 2))));
    all.push_back(partsOf(colour, 16, true, part("tRNS", std::string(6, '\1'))));
    all.push_back(partsOf(palette, 2, false, part("tRNS", "\x10\x80")));
    for (int orientation = 1; orientation <= 8; ++orientation)
        all.push_back(
            partsOf(orientation % 2 == 0 ? colour : grey, 8, false, part("eXIf", orientationMark(orientation, orientation > 4))));
    return all;
}

}  // namespace fuzz
