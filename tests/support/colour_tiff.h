// A colour TIFF as photographs have it, made byte by byte.
#pragma once

#include <iterator>
#include <string>

namespace tests::support {

/// 16 x 16 pixels of RGB (200, 100, 50), uncompressed, in one strip.
inline std::string tiffOfOneColour(int photometric, int orientation)
{
    std::string bytes("II*\0\x08\0\0\0", 8);
    const auto number = [&bytes](unsigned value, int length) {
        for (int i = 0; i < length; ++i) bytes += static_cast<char>(value >> (8 * i) & 255);
    };
    constexpr unsigned entries[][3] = {{256, 3, 16}, {257, 3, 16}, {258, 3, 8}, {259, 3, 1},  {262, 3, 0},
                                       {273, 4, 0},  {274, 3, 0},  {277, 3, 3}, {278, 3, 16}, {279, 4, 768}};
    constexpr unsigned count = std::size(entries), pixels = 8 + 2 + 12 * count + 4 + 6;
    number(count, 2);
    for (const auto& [tag, type, value] : entries) {
        number(tag, 2);
        number(type, 2);
        number(tag == 258 ? 3 : 1, 4);
        number(tag == 258   ? pixels - 6
               : tag == 262 ? static_cast<unsigned>(photometric)
               : tag == 274 ? static_cast<unsigned>(orientation)
               : tag == 273 ? pixels
                            : value,
               4);
    }
    number(0, 4);
    for (int i = 0; i < 3; ++i) number(8, 2);
    for (int i = 0; i < 256; ++i) bytes += "\xC8\x64\x32";
    return bytes;
}

}  // namespace tests::support
