#include "rendering/images/image_io.h"

#include <algorithm>
#include <bit>
#include <cctype>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include "protocols/files/errors.h"
#include "protocols/files/whole_file.h"

namespace rendering {

static_assert(std::endian::native == std::endian::little, "arrays are copied from little-endian files without byte swaps");

namespace {

constexpr std::uint64_t largestElementCount = 1ull << 28;

protocols::Error notReadable(const std::filesystem::path& file, const std::string& kind, const std::string& why)
{
    const bool npy = kind == ".npy array";
    return protocols::badInput({"is not a readable " + kind + " (" + why + ")", file.string(),
                                npy ? "version 1, C order, little endian, one to three dimensions of f4, f8 or integers"
                                    : "a binary 8-bit PGM (P5, maximum 255)",
                                "save it again"});
}

struct NpyHeader {
    char kind = 0;  ///< f, u, i or b
    int bytes = 0;
    std::vector<std::uint64_t> shape;
    std::size_t dataStart = 0;
};

/// Text after 'key': in the header dictionary of numpy.
std::string_view valueAfter(std::string_view header, std::string_view key)
{
    const auto at = header.find(key);
    if (at == std::string_view::npos) return {};
    std::string_view rest = header.substr(at + key.size());
    while (!rest.empty() && (rest.front() == ' ' || rest.front() == ':')) rest.remove_prefix(1);
    return rest;
}

std::vector<std::uint64_t> shapeIn(std::string_view text, const std::filesystem::path& file)
{
    std::vector<std::uint64_t> shape;
    const auto end = text.find(')');
    if (text.empty() || text.front() != '(' || end == std::string_view::npos) throw notReadable(file, ".npy array", "no shape");
    const char* position = text.data() + 1;
    const char* const last = text.data() + end;
    while (position < last) {
        if (*position == ' ' || *position == ',') {
            ++position;
            continue;
        }
        std::uint64_t size = 0;
        const auto [next, problem] = std::from_chars(position, last, size);
        if (problem != std::errc{}) throw notReadable(file, ".npy array", "a malformed shape");
        shape.push_back(size);
        position = next;
    }
    return shape;
}

NpyHeader npyHeader(std::string_view bytes, const std::filesystem::path& file)
{
    using namespace std::string_view_literals;
    if (bytes.size() < 10 || !bytes.starts_with("\x93NUMPY"sv)) throw notReadable(file, ".npy array", "no numpy signature");
    const auto byteAt = [&](std::size_t at) { return std::size_t(static_cast<unsigned char>(bytes[at])); };
    if (bytes[6] != 1) throw notReadable(file, ".npy array", "format version " + std::to_string(int(byteAt(6))));
    NpyHeader header;
    header.dataStart = 10 + byteAt(8) + 256 * byteAt(9);
    if (header.dataStart > bytes.size()) throw notReadable(file, ".npy array", "truncated in its header");
    const std::string_view text = bytes.substr(10, header.dataStart - 10);
    const std::string_view type = valueAfter(text, "'descr'");
    if (type.size() < 5 || (type[0] != '\'') || (type[1] == '>') || !std::isdigit(static_cast<unsigned char>(type[3])) ||
        type[4] != '\'')
        throw notReadable(file, ".npy array", "big-endian or structured elements");
    header.kind = type[2];
    header.bytes = type[3] - '0';
    if (!valueAfter(text, "'fortran_order'").starts_with("False")) throw notReadable(file, ".npy array", "Fortran order");
    header.shape = shapeIn(valueAfter(text, "'shape'"), file);
    return header;
}

template <class From>
void widen(const char* from, double* to, std::size_t count)
{
    for (std::size_t i = 0; i < count; ++i) {
        From value;
        std::memcpy(&value, from + i * sizeof(From), sizeof(From));
        to[i] = static_cast<double>(value);
    }
}

/// An element type of numpy and the OpenCV depth that holds it; `toDouble` is set where OpenCV has no such type.
struct NpyType {
    char kind;
    int bytes;
    int depth;
    void (*toDouble)(const char*, double*, std::size_t);
};

constexpr NpyType npyTypes[] = {
    {'f', 4, CV_32F, nullptr},
    {'f', 8, CV_64F, nullptr},
    {'u', 1, CV_8U, nullptr},
    {'b', 1, CV_8U, nullptr},
    {'u', 2, CV_16U, nullptr},
    {'i', 1, CV_64F, widen<std::int8_t>},
    {'i', 2, CV_64F, widen<std::int16_t>},
    {'i', 4, CV_64F, widen<std::int32_t>},
    {'i', 8, CV_64F, widen<std::int64_t>},
    {'u', 4, CV_64F, widen<std::uint32_t>},
    {'u', 8, CV_64F, widen<std::uint64_t>},
};

const NpyType* npyTypeOf(const NpyHeader& header)
{
    const auto found = std::find_if(std::begin(npyTypes), std::end(npyTypes),
                                    [&](const NpyType& type) { return type.kind == header.kind && type.bytes == header.bytes; });
    return found == std::end(npyTypes) ? nullptr : &*found;
}

/// Skips blanks and comment lines, then reads one number of a PGM header.
int pgmNumber(std::string_view bytes, std::size_t& at, const std::filesystem::path& file)
{
    while (at < bytes.size() && (std::isspace(static_cast<unsigned char>(bytes[at])) || bytes[at] == '#')) {
        if (bytes[at] == '#')
            while (at < bytes.size() && bytes[at] != '\n') ++at;
        else
            ++at;
    }
    int value = 0;
    const auto [next, problem] = std::from_chars(bytes.data() + at, bytes.data() + bytes.size(), value);
    if (problem != std::errc{} || value <= 0) throw notReadable(file, "PGM", "a malformed header");
    at = std::size_t(next - bytes.data());
    return value;
}

}  // namespace

cv::Mat readNpy(const std::filesystem::path& file)
{
    const std::string bytes = protocols::readWholeFile(file);
    const NpyHeader header = npyHeader(bytes, file);
    const NpyType* type = npyTypeOf(header);
    if (!type)
        throw notReadable(file, ".npy array", std::string("elements of type ") + header.kind + std::to_string(header.bytes));
    const auto& shape = header.shape;
    if (shape.empty() || shape.size() > 3) throw notReadable(file, ".npy array", std::to_string(shape.size()) + " dimensions");
    const std::uint64_t rows = shape.size() == 1 ? 1 : shape[0];
    const std::uint64_t columns = shape.size() == 1 ? shape[0] : shape[1];
    const std::uint64_t channels = shape.size() == 3 ? shape[2] : 1;
    if (rows == 0 || columns == 0 || (channels != 1 && channels != 3) || rows > largestElementCount ||
        columns > largestElementCount || rows * columns > largestElementCount)
        throw notReadable(file, ".npy array", "its shape is empty, too large or not that of an image");
    const std::size_t count = std::size_t(rows * columns * channels);
    if (bytes.size() - header.dataStart != count * std::size_t(header.bytes))
        throw notReadable(file, ".npy array", "the length of its data does not match its shape");
    cv::Mat array(int(rows), int(columns), CV_MAKETYPE(type->depth, int(channels)));
    if (type->toDouble)
        type->toDouble(bytes.data() + header.dataStart, array.ptr<double>(), count);
    else
        std::memcpy(array.data, bytes.data() + header.dataStart, count * std::size_t(header.bytes));
    return array;
}

void writeNpy(const std::filesystem::path& file, const cv::Mat& array, protocols::Sync sync)
{
    CV_Assert(!array.empty() && (array.channels() == 1 || array.channels() == 3));
    const auto stored = std::find_if(std::begin(npyTypes), std::end(npyTypes),
                                     [&](const NpyType& type) { return type.depth == array.depth() && !type.toDouble; });
    CV_Assert(stored != std::end(npyTypes));
    std::string header = "{'descr': '";
    header += stored->bytes == 1 ? '|' : '<';
    header += stored->kind;
    header += std::to_string(stored->bytes) + "', 'fortran_order': False, 'shape': (" + std::to_string(array.rows) + ", " +
              std::to_string(array.cols) + (array.channels() == 3 ? ", 3), }" : "), }");
    header.append((64 - (10 + header.size() + 1) % 64) % 64, ' ');  // numpy aligns the data to 64 bytes.
    header += '\n';
    std::string bytes("\x93NUMPY\x01\x00", 8);
    bytes += char(header.size() % 256);
    bytes += char(header.size() / 256);
    bytes += header;
    for (int row = 0; row < array.rows; ++row)
        bytes.append(reinterpret_cast<const char*>(array.ptr(row)), std::size_t(array.cols) * array.elemSize());
    protocols::writeWholeFile(file, bytes, sync);
}

cv::Mat readPgm(const std::filesystem::path& file) { return pgmOfBytes(protocols::readWholeFile(file), file); }

cv::Mat pgmOfBytes(std::string_view bytes, const std::filesystem::path& file)
{
    if (!bytes.starts_with("P5")) throw notReadable(file, "PGM", "no P5 signature");
    std::size_t at = 2;
    const int width = pgmNumber(bytes, at, file);
    const int height = pgmNumber(bytes, at, file);
    if (pgmNumber(bytes, at, file) != 255) throw notReadable(file, "PGM", "its maximum is not 255");
    ++at;  // A single blank ends the header.
    if (std::uint64_t(width) * std::uint64_t(height) > largestElementCount) throw notReadable(file, "PGM", "too many pixels");
    if (at > bytes.size() || bytes.size() - at != std::size_t(width) * std::size_t(height))
        throw notReadable(file, "PGM", "the length of its data does not match its header");
    cv::Mat image(height, width, CV_8UC1);
    std::memcpy(image.data, bytes.data() + at, bytes.size() - at);
    return image;
}

void writePgm(const std::filesystem::path& file, const cv::Mat& image, protocols::Sync sync)
{
    protocols::writeWholeFile(file, pgmBytes(image), sync);
}

std::string pgmBytes(const cv::Mat& image)
{
    CV_Assert(!image.empty() && image.type() == CV_8UC1);
    std::string bytes = "P5\n" + std::to_string(image.cols) + " " + std::to_string(image.rows) + "\n255\n";
    for (int row = 0; row < image.rows; ++row)
        bytes.append(reinterpret_cast<const char*>(image.ptr(row)), std::size_t(image.cols));
    return bytes;
}

cv::Mat readImage(const std::filesystem::path& file)
{
    struct FileReader {
        std::string_view ending;
        cv::Mat (*read)(const std::filesystem::path&);
    };
    static constexpr FileReader readers[] = {
        {".png", readPng}, {".tif", readTiff}, {".tiff", readTiff}, {".npy", readNpy}, {".pgm", readPgm}};
    std::string ending = file.extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](unsigned char c) { return char(c >= 'A' && c <= 'Z' ? c + 32 : c); });
    for (const FileReader& reader : readers)
        if (reader.ending == ending) return reader.read(file);
    throw protocols::badInput(
        {"has an unknown file ending", file.string(), ".png, .tif, .tiff, .npy or .pgm", "convert it to PNG"});
}

}  // namespace rendering
