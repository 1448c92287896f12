// libpng reports errors by longjmp, so the functions that call setjmp hold no object with a destructor.
// Their callers own the buffers.
#include "rendering/images/image_png.h"

#include <png.h>

#include <csetjmp>
#include <cstdint>
#include <cstring>
#include <exception>
#include <opencv2/core.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "protocols/files/errors.h"
#include "protocols/files/whole_file.h"
#include "rendering/images/exif.h"

namespace rendering {

namespace {

constexpr std::uint64_t mostPngPixels = 1ull << 28;
constexpr std::uint64_t mostPngBytes = 3 * mostPngPixels;  // decoded: as many as the largest image in 8-bit RGB has
constexpr int compressionLevel = 3;  // Higher levels take several times as long for a few percent of the size.

struct ByteSource {
    const unsigned char* bytes;
    std::size_t size;
    std::size_t position;
};

struct Decoding {
    png_structp png = nullptr;
    png_infop info = nullptr;
    ByteSource source{};
    char message[120] = {};
    png_uint_32 width = 0, height = 0;
    int bitDepth = 0, channels = 0;
    std::size_t storedRowBytes = 0;  ///< before palettes and single bits are expanded
    png_bytep exif = nullptr;        ///< owned by libpng
    png_uint_32 exifSize = 0;
};

void keepMessage(char* to, const char* text) { std::strncpy(to, text, 119); }

void onReadError(png_structp png, png_const_charp text)
{
    keepMessage(static_cast<Decoding*>(png_get_error_ptr(png))->message, text);
    png_longjmp(png, 1);
}

void onWarning(png_structp, png_const_charp) {}

void takeBytes(png_structp png, png_bytep to, png_size_t count)
{
    auto* source = static_cast<ByteSource*>(png_get_io_ptr(png));
    if (count > source->size - source->position) png_error(png, "the file is truncated");
    std::memcpy(to, source->bytes + source->position, count);
    source->position += count;
}

/// Skips what describes the image, except the orientation mark and transparency. Compressed texts and profiles would be unpacked:
/// up to 1000 of them, 8 MB each.
void skipDescriptions(png_structp png)
{
    constexpr int allKnown = -1;  // libpng keeps PLTE, tRNS, IDAT and the like out of this list.
    png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_NEVER, nullptr, allKnown);
    png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_AS_DEFAULT, reinterpret_cast<png_const_bytep>("eXIf"), 1);
}

bool readHeader(Decoding& decoding)
{
    if (setjmp(png_jmpbuf(decoding.png))) return false;
    png_set_read_fn(decoding.png, &decoding.source, takeBytes);
    png_set_user_limits(decoding.png, 1u << 20, 1u << 20);
    skipDescriptions(decoding.png);
    png_read_info(decoding.png, decoding.info);
    decoding.storedRowBytes = png_get_rowbytes(decoding.png, decoding.info);
    const int type = png_get_color_type(decoding.png, decoding.info);
    if (type == PNG_COLOR_TYPE_PALETTE || png_get_bit_depth(decoding.png, decoding.info) < 8) png_set_expand(decoding.png);
    if ((type & PNG_COLOR_MASK_ALPHA) != 0 || png_get_valid(decoding.png, decoding.info, PNG_INFO_tRNS) != 0)
        png_set_strip_alpha(decoding.png);
    png_set_swap(decoding.png);  // 16-bit samples are big-endian in the file.
    png_set_interlace_handling(decoding.png);
    png_read_update_info(decoding.png, decoding.info);
    decoding.width = png_get_image_width(decoding.png, decoding.info);
    decoding.height = png_get_image_height(decoding.png, decoding.info);
    decoding.bitDepth = png_get_bit_depth(decoding.png, decoding.info);
    decoding.channels = png_get_channels(decoding.png, decoding.info);
    return true;
}

bool readRows(Decoding& decoding, png_bytepp rows)
{
    if (setjmp(png_jmpbuf(decoding.png))) return false;
    png_read_image(decoding.png, rows);
    png_read_end(decoding.png, decoding.info);
    png_get_eXIf_1(decoding.png, decoding.info, &decoding.exifSize, &decoding.exif);
    return true;
}

/// 5 to 8 have rows and columns exchanged.
bool exchangesSides(unsigned orientation) { return orientation >= 5; }

/// The image as a camera's mark asks to show it.
cv::Mat turned(const cv::Mat& image, unsigned orientation)
{
    cv::Mat upright = image;
    if (exchangesSides(orientation)) cv::transpose(image, upright);
    constexpr int leftRight = 1, upDown = 0, both = -1;
    if (orientation == 2 || orientation == 6) cv::flip(upright, upright, leftRight);
    if (orientation == 4 || orientation == 8) cv::flip(upright, upright, upDown);
    if (orientation == 3 || orientation == 7) cv::flip(upright, upright, both);
    return upright;
}

struct Encoding {
    std::string* bytes = nullptr;
    char message[120] = {};
};

void onWriteError(png_structp png, png_const_charp text)
{
    keepMessage(static_cast<Encoding*>(png_get_error_ptr(png))->message, text);
    png_longjmp(png, 1);
}

/// False where there is no memory: no exception may pass through libpng.
bool wasAppended(std::string& bytes, const char* from, std::size_t count)
{
    try {
        bytes.append(from, count);
        return true;
    } catch (const std::exception&) {
        return false;
    }
}

void giveBytes(png_structp png, png_bytep from, png_size_t count)
{
    std::string& bytes = *static_cast<Encoding*>(png_get_io_ptr(png))->bytes;
    if (!wasAppended(bytes, reinterpret_cast<const char*>(from), count)) png_error(png, "the memory is used up");
}

bool encodeRows(png_structp png, png_infop info, const cv::Mat& image, Encoding& encoding)
{
    if (setjmp(png_jmpbuf(png))) return false;
    png_set_write_fn(png, &encoding, giveBytes, nullptr);
    const int colour = image.channels() == 3 ? PNG_COLOR_TYPE_RGB : PNG_COLOR_TYPE_GRAY;
    const bool deep = image.depth() == CV_16U;
    png_set_IHDR(png, info, static_cast<png_uint_32>(image.cols), static_cast<png_uint_32>(image.rows), deep ? 16 : 8, colour,
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_compression_level(png, compressionLevel);
    png_set_filter(png, 0, PNG_FILTER_SUB);
    png_write_info(png, info);
    if (deep) png_set_swap(png);
    for (int row = 0; row < image.rows; ++row) png_write_row(png, image.ptr(row));
    png_write_end(png, nullptr);
    return true;
}

protocols::Error notAPng(const std::filesystem::path& file, const std::string& why)
{
    return protocols::badInput({"is not a readable PNG (" + why + ")", file.string(), "a complete PNG image", "export it again"});
}

/// Refuses an image that is too large for the memory, and a header that promises more than the file can hold.
void requirePngSize(const Decoding& decoding, std::size_t fileBytes, const std::filesystem::path& file)
{
    const std::uint64_t pixels = std::uint64_t(decoding.width) * decoding.height;
    const std::uint64_t pixelBytes = unsigned(decoding.channels * decoding.bitDepth / 8);
    if (pixels > mostPngPixels || pixels * pixelBytes > mostPngBytes)
        throw protocols::badInput(
            {"has " + std::to_string(decoding.width) + " x " + std::to_string(decoding.height) + " pixels of " +
                 std::to_string(pixelBytes) + (pixelBytes == 1 ? " byte" : " bytes"),
             file.string(),
             "at most " + std::to_string(mostPngPixels) + " pixels and " + std::to_string(mostPngBytes) + " bytes when decoded",
             "reduce the image, or export it with 8 bits"});
    // Deflate shrinks data by at most about 1032:1. Each stored row begins with the byte of its filter.
    const std::uint64_t stored = (std::uint64_t(decoding.storedRowBytes) + 1) * decoding.height;
    if (stored > fileBytes * 1100ull + (1u << 20)) throw notAPng(file, "the file is truncated");
}

struct ReadHandle {
    Decoding decoding;
    ReadHandle()
    {
        decoding.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &decoding, onReadError, onWarning);
        decoding.info = decoding.png ? png_create_info_struct(decoding.png) : nullptr;
    }
    ~ReadHandle() { png_destroy_read_struct(&decoding.png, &decoding.info, nullptr); }
    ReadHandle(const ReadHandle&) = delete;
    ReadHandle& operator=(const ReadHandle&) = delete;
};

struct WriteHandle {
    png_structp png;
    png_infop info;
    explicit WriteHandle(Encoding& encoding)
        : png(png_create_write_struct(PNG_LIBPNG_VER_STRING, &encoding, onWriteError, onWarning)),
          info(png ? png_create_info_struct(png) : nullptr)
    {
    }
    ~WriteHandle() { png_destroy_write_struct(&png, &info); }
    WriteHandle(const WriteHandle&) = delete;
    WriteHandle& operator=(const WriteHandle&) = delete;
};

}  // namespace

cv::Mat readPng(const std::filesystem::path& file)
{
    const std::string bytes = protocols::readWholeFile(file);
    if (bytes.size() < 8 || png_sig_cmp(reinterpret_cast<png_const_bytep>(bytes.data()), 0, 8) != 0)
        throw notAPng(file, "no PNG signature");
    ReadHandle handle;
    Decoding& decoding = handle.decoding;
    if (!decoding.info)
        throw protocols::environmentFault(
            {"not enough memory to decode the image", file.string(), "", "close other programs and try again"});
    decoding.source = {reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size(), 0};
    if (!readHeader(decoding)) throw notAPng(file, decoding.message);
    requirePngSize(decoding, bytes.size(), file);
    const int depth = decoding.bitDepth == 16 ? CV_16U : CV_8U;
    cv::Mat image(int(decoding.height), int(decoding.width), CV_MAKETYPE(depth, decoding.channels));
    std::vector<png_bytep> rows(decoding.height);
    for (int row = 0; row < image.rows; ++row) rows[std::size_t(row)] = image.ptr(row);
    if (!readRows(decoding, rows.data())) throw notAPng(file, decoding.message);
    const char* const exif = reinterpret_cast<const char*>(decoding.exif);
    return turned(image, Exif(exif ? std::string_view(exif, decoding.exifSize) : std::string_view()).orientation());
}

bool pngLiesOnItsSide(std::string_view png)
{
    constexpr std::size_t signatureBytes = 8, headBytes = 8, checksumBytes = 4;
    const auto* const bytes = reinterpret_cast<const unsigned char*>(png.data());
    for (std::size_t at = signatureBytes; at + headBytes + checksumBytes <= png.size();) {
        const std::size_t length = png_get_uint_32(bytes + at);
        if (length > png.size() - at - headBytes - checksumBytes) return false;
        if (png.substr(at + 4, 4) == "eXIf") return exchangesSides(Exif(png.substr(at + headBytes, length)).orientation());
        at += headBytes + length + checksumBytes;
    }
    return false;
}

void writePng(const std::filesystem::path& file, const cv::Mat& image, protocols::Sync sync)
{
    CV_Assert(!image.empty() && (image.channels() == 1 || image.channels() == 3) &&
              (image.depth() == CV_8U || image.depth() == CV_16U));
    std::string bytes;
    Encoding encoding{&bytes, {}};
    WriteHandle handle(encoding);
    if (!handle.info || !encodeRows(handle.png, handle.info, image, encoding))
        throw protocols::environmentFault({std::string("cannot be encoded (") + encoding.message + ")", file.string(),
                                           "enough memory", "close other programs and try again"});
    protocols::writeWholeFile(file, bytes, sync);
}

}  // namespace rendering
