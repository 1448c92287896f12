#include "rendering/images/true_map.h"

#include <algorithm>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

#include "protocols/files/errors.h"
#include "protocols/files/whole_file.h"

namespace rendering {

static_assert(std::endian::native == std::endian::little, "heights are copied from little-endian files without byte swaps");

namespace {

constexpr std::size_t headerBytes = 32;
constexpr std::uint64_t mostPoints = 1ull << 28;
constexpr float missingBelow = -1e9F;  ///< mm; the file marks missing points with -1e10

protocols::Error notATrueMap(const std::string& where, const std::string& why)
{
    return protocols::badInput({.what = "is not a readable TrueMap height map (" + why + ")",
                                .where = where,
                                .expected = "\"Binary TrueMap Data File v2.0\" with all its heights",
                                .nextStep = "export it again"});
}

template <class T>
T valueAt(std::string_view bytes, std::size_t place)
{
    T value;
    std::memcpy(&value, bytes.data() + place, sizeof value);
    return value;
}

bool isHeader(std::string_view bytes)
{
    std::string start(bytes.substr(0, std::min(bytes.size(), headerBytes)));
    std::transform(start.begin(), start.end(), start.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return start.starts_with("binary truemap data file v2");
}

}  // namespace

TrueMap trueMapFrom(std::string_view bytes, const std::string& where)
{
    if (!isHeader(bytes)) throw notATrueMap(where, "unknown header");
    const std::size_t commentEnd = bytes.find('\0', headerBytes);
    if (commentEnd == std::string_view::npos || bytes.size() - commentEnd - 1 < 24)
        throw notATrueMap(where, "truncated in its header");
    const std::size_t start = commentEnd + 1;
    const std::uint64_t columns = valueAt<std::uint32_t>(bytes, start), rows = valueAt<std::uint32_t>(bytes, start + 4);
    if (columns == 0 || rows == 0) throw notATrueMap(where, "no points");
    if (columns > mostPoints || rows > mostPoints || columns * rows > mostPoints)
        throw notATrueMap(where, "more than 2^28 points");
    const double width = valueAt<float>(bytes, start + 8), height = valueAt<float>(bytes, start + 12);
    if (!(width > 0 && height > 0 && std::isfinite(width) && std::isfinite(height)))
        throw notATrueMap(where, "its width or height in mm is not positive");
    const std::size_t size = static_cast<std::size_t>(rows * columns) * sizeof(float);
    if (bytes.size() - start - 24 < size)
        throw notATrueMap(where, "truncated after " + std::to_string((bytes.size() - start - 24) / sizeof(float)) + " of " +
                                     std::to_string(rows * columns) + " heights");
    TrueMap map{cv::Mat(static_cast<int>(rows), static_cast<int>(columns), CV_32FC1), width / static_cast<double>(columns),
                height / static_cast<double>(rows), std::string(bytes.substr(headerBytes, commentEnd - headerBytes))};
    std::memcpy(map.heightMm.data, bytes.data() + start + 24, size);
    for (float& value : cv::Mat_<float>(map.heightMm))
        if (!(value > missingBelow) || !std::isfinite(value)) value = std::numeric_limits<float>::quiet_NaN();
    return map;
}

TrueMap readTrueMap(const std::filesystem::path& file) { return trueMapFrom(protocols::readWholeFile(file), file.string()); }

}  // namespace rendering
