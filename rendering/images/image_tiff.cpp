// libtiff reads from memory and writes to memory. Each handle keeps its own error text, because libtiff's
// global handlers would mix up threads.
#include "rendering/images/image_tiff.h"

#include <tiffio.h>

#include <algorithm>
#include <cstdarg>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <exception>
#include <memory>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "protocols/files/errors.h"
#include "protocols/files/whole_file.h"

namespace rendering {

namespace {

constexpr std::uint64_t mostTiffPixels = 1ull << 28;
constexpr std::uint64_t mostTiffBytes = 4 * mostTiffPixels;  // decoded: as many as the largest map of 32-bit float has

struct Memory {
    std::string bytes;
    std::uint64_t position = 0;
    std::string message;
    bool isUsedUp = false;  ///< something could not be written
};

Memory& memoryOf(thandle_t handle) { return *static_cast<Memory*>(handle); }

tmsize_t readFrom(thandle_t handle, void* to, tmsize_t count)
{
    Memory& memory = memoryOf(handle);
    if (memory.position >= memory.bytes.size()) return 0;
    const auto left = memory.bytes.size() - memory.position;
    const auto taken = std::min<std::uint64_t>(left, std::uint64_t(count));
    std::memcpy(to, memory.bytes.data() + memory.position, taken);
    memory.position += taken;
    return tmsize_t(taken);
}

tmsize_t writeTo(thandle_t handle, void* from, tmsize_t count)
{
    Memory& memory = memoryOf(handle);
    try {
        if (memory.bytes.size() < memory.position + std::uint64_t(count))
            memory.bytes.resize(memory.position + std::uint64_t(count));
    } catch (const std::exception&) {  // none may pass through libtiff
        memory.isUsedUp = true;
        return -1;
    }
    std::memcpy(memory.bytes.data() + memory.position, from, std::size_t(count));
    memory.position += std::uint64_t(count);
    return count;
}

toff_t seekIn(thandle_t handle, toff_t offset, int whence)
{
    Memory& memory = memoryOf(handle);
    const std::uint64_t base = whence == SEEK_SET ? 0 : whence == SEEK_CUR ? memory.position : memory.bytes.size();
    return memory.position = base + offset;
}

int closeNothing(thandle_t) { return 0; }
toff_t sizeOf(thandle_t handle) { return memoryOf(handle).bytes.size(); }
int mapNothing(thandle_t, void**, toff_t*) { return 0; }
void unmapNothing(thandle_t, void*, toff_t) {}

int keepError(TIFF*, void* user, const char*, const char* format, va_list arguments)
{
    char text[160];
    std::vsnprintf(text, sizeof text, format, arguments);
    try {
        static_cast<Memory*>(user)->message = text;
    } catch (const std::exception&) {
        // Without memory for its reason the fault has none.
    }
    return 1;
}

int ignoreWarning(TIFF*, void*, const char*, const char*, va_list) { return 1; }

struct CloseTiff {
    void operator()(TIFF* tiff) const { TIFFClose(tiff); }
};
using OpenTiff = std::unique_ptr<TIFF, CloseTiff>;

OpenTiff open(Memory& memory, const std::filesystem::path& file, const char* mode)
{
    const std::unique_ptr<TIFFOpenOptions, decltype(&TIFFOpenOptionsFree)> options(TIFFOpenOptionsAlloc(), TIFFOpenOptionsFree);
    TIFFOpenOptionsSetErrorHandlerExtR(options.get(), keepError, &memory);
    TIFFOpenOptionsSetWarningHandlerExtR(options.get(), ignoreWarning, &memory);
    return OpenTiff(TIFFClientOpenExt(file.c_str(), mode, &memory, readFrom, writeTo, seekIn, closeNothing, sizeOf, mapNothing,
                                      unmapNothing, options.get()));
}

protocols::Error notATiff(const std::filesystem::path& file, const std::string& why, bool mayHaveColours = false)
{
    if (mayHaveColours)
        return protocols::badInput({"is a TIFF that this program does not read (" + why + ")", file.string(),
                                    "an upright TIFF in strips, grey or interleaved RGB, of 8 or 16 bits",
                                    "export it again, or convert it to PNG"});
    return protocols::badInput({"is not a readable TIFF (" + why + ")", file.string(),
                                "one upright channel of 32-bit float, 16-bit or 8-bit samples in strips", "export it again"});
}

/// Numbers of a palette, negatives and pictures that lie on their side would be read as other pixels. Negatives are not inverted:
/// some programs set that mark for their view alone, so that the numbers are right as they stand.
void requirePlainColours(TIFF* tiff, const std::filesystem::path& file, bool mayHaveColours)
{
    std::uint16_t samples = 1, kind = 0, orientation = ORIENTATION_TOPLEFT;
    TIFFGetFieldDefaulted(tiff, TIFFTAG_SAMPLESPERPIXEL, &samples);
    const bool statesKind = TIFFGetField(tiff, TIFFTAG_PHOTOMETRIC, &kind) == 1;
    TIFFGetFieldDefaulted(tiff, TIFFTAG_ORIENTATION, &orientation);
    if (statesKind && samples == 1 && kind == PHOTOMETRIC_MINISWHITE)
        throw protocols::badInput({"is a TIFF in which 0 is white (WhiteIsZero), so bright and dark may be exchanged",
                                   file.string(), "0 is black (BlackIsZero)", "save it as BlackIsZero, or convert it to PNG"});
    std::string why;
    if (statesKind && kind != (samples == 1 ? PHOTOMETRIC_MINISBLACK : PHOTOMETRIC_RGB))
        why = "its colours are neither grey nor RGB";
    else if (orientation != ORIENTATION_TOPLEFT)
        why = "its orientation mark turns or mirrors it";
    if (!why.empty()) throw notATiff(file, why, mayHaveColours);
}

int typeOf(TIFF* tiff, const std::filesystem::path& file, bool mayHaveColours)
{
    std::uint16_t bits = 1, samples = 1, format = SAMPLEFORMAT_UINT, planes = PLANARCONFIG_CONTIG;
    TIFFGetFieldDefaulted(tiff, TIFFTAG_PLANARCONFIG, &planes);
    TIFFGetFieldDefaulted(tiff, TIFFTAG_BITSPERSAMPLE, &bits);
    TIFFGetFieldDefaulted(tiff, TIFFTAG_SAMPLESPERPIXEL, &samples);
    TIFFGetFieldDefaulted(tiff, TIFFTAG_SAMPLEFORMAT, &format);
    if (mayHaveColours && (samples == 3 || samples == 4) && planes == PLANARCONFIG_CONTIG && format == SAMPLEFORMAT_UINT &&
        (bits == 8 || bits == 16))
        return CV_MAKETYPE(bits == 8 ? CV_8U : CV_16U, samples);
    const bool isPlanar = mayHaveColours && samples > 1 && planes != PLANARCONFIG_CONTIG;
    if (samples != 1) throw notATiff(file, std::to_string(samples) + (isPlanar ? " planes" : " channels"), mayHaveColours);
    if (format == SAMPLEFORMAT_IEEEFP && bits == 32) return CV_32FC1;
    if (format == SAMPLEFORMAT_UINT && (bits == 8 || bits == 16)) return bits == 8 ? CV_8UC1 : CV_16UC1;
    throw notATiff(file, std::to_string(bits) + " bits of sample format " + std::to_string(format), mayHaveColours);
}

/// Bytes of pixels for each byte of the file, at most: the longest repetition that a code of this compression can stand for.
std::uint64_t mostExpansion(TIFF* tiff)
{
    std::uint16_t compression = COMPRESSION_NONE;
    TIFFGetFieldDefaulted(tiff, TIFFTAG_COMPRESSION, &compression);
    switch (compression) {
        case COMPRESSION_NONE:
            return 1;
        case COMPRESSION_PACKBITS:
            return 64;
        case COMPRESSION_DEFLATE:
        case COMPRESSION_ADOBE_DEFLATE:
            return 1100;
        case COMPRESSION_LZW:
            return 2700;
        default:
            return 1u << 16;  // ZSTD and LZMA state repetitions by their length
    }
}

cv::Mat readPixels(const std::filesystem::path& file, bool mayHaveColours)
{
    Memory memory{protocols::readWholeFile(file), 0, {}};
    const OpenTiff tiff = open(memory, file, "rm");
    if (!tiff) throw notATiff(file, memory.message.empty() ? "no TIFF header" : memory.message);
    std::uint32_t width = 0, height = 0;
    TIFFGetField(tiff.get(), TIFFTAG_IMAGEWIDTH, &width);
    TIFFGetField(tiff.get(), TIFFTAG_IMAGELENGTH, &height);
    const int type = typeOf(tiff.get(), file, mayHaveColours);
    requirePlainColours(tiff.get(), file, mayHaveColours);
    const std::uint64_t pixels = std::uint64_t(width) * height;
    if (pixels == 0 || pixels > mostTiffPixels)
        throw notATiff(file, std::to_string(width) + " x " + std::to_string(height) + " pixels");
    if (pixels * CV_ELEM_SIZE(type) > mostTiffBytes)
        throw protocols::badInput({"has " + std::to_string(width) + " x " + std::to_string(height) + " pixels of " +
                                       std::to_string(CV_ELEM_SIZE(type)) + " bytes",
                                   file.string(), "at most " + std::to_string(mostTiffBytes) + " bytes when decoded",
                                   "reduce the image, or export it with 8 bits"});
    if (TIFFIsTiled(tiff.get())) throw notATiff(file, "tiled", mayHaveColours);
    if (pixels * CV_ELEM_SIZE(type) > memory.bytes.size() * mostExpansion(tiff.get()) + (1u << 20))
        throw notATiff(file, "the file is truncated");
    cv::Mat image(int(height), int(width), type);
    if (TIFFScanlineSize64(tiff.get()) != std::uint64_t(width) * CV_ELEM_SIZE(type))
        throw notATiff(file, "the length of its rows does not match its width");
    for (int row = 0; row < image.rows; ++row)
        if (TIFFReadScanline(tiff.get(), image.ptr(row), std::uint32_t(row)) < 0)
            throw notATiff(file, memory.message.empty() ? "truncated" : memory.message);
    return image;
}

}  // namespace

cv::Mat readTiff(const std::filesystem::path& file) { return readPixels(file, false); }

cv::Mat readColourTiff(const std::filesystem::path& file)
{
    const cv::Mat image = readPixels(file, true);
    if (image.channels() != 4) return image;
    cv::Mat colours(image.size(), CV_MAKETYPE(image.depth(), 3));
    cv::mixChannels(std::vector<cv::Mat>{image}, std::vector<cv::Mat>{colours}, {0, 0, 1, 1, 2, 2});
    return colours;
}

void writeTiff(const std::filesystem::path& file, const cv::Mat& image, protocols::Sync sync)
{
    CV_Assert(!image.empty() && image.type() == CV_32FC1);
    Memory memory;
    bool good = true;
    {
        const OpenTiff tiff = open(memory, file, "wl");
        good = tiff != nullptr;
        if (good) {
            TIFFSetField(tiff.get(), TIFFTAG_IMAGEWIDTH, std::uint32_t(image.cols));
            TIFFSetField(tiff.get(), TIFFTAG_IMAGELENGTH, std::uint32_t(image.rows));
            TIFFSetField(tiff.get(), TIFFTAG_SAMPLESPERPIXEL, 1);
            TIFFSetField(tiff.get(), TIFFTAG_BITSPERSAMPLE, 32);
            TIFFSetField(tiff.get(), TIFFTAG_SAMPLEFORMAT, SAMPLEFORMAT_IEEEFP);
            TIFFSetField(tiff.get(), TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK);
            TIFFSetField(tiff.get(), TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
            TIFFSetField(tiff.get(), TIFFTAG_COMPRESSION, COMPRESSION_ADOBE_DEFLATE);
            TIFFSetField(tiff.get(), TIFFTAG_PREDICTOR, PREDICTOR_FLOATINGPOINT);
            TIFFSetField(tiff.get(), TIFFTAG_ZIPQUALITY, 4);
            TIFFSetField(tiff.get(), TIFFTAG_ROWSPERSTRIP, std::uint32_t(image.rows));
        }
        // With a predictor libtiff changes the buffer that it gets, so each row is passed as a copy.
        std::string row(std::size_t(image.cols) * sizeof(float), '\0');
        for (int y = 0; good && y < image.rows; ++y) {
            std::memcpy(row.data(), image.ptr(y), row.size());
            good = TIFFWriteScanline(tiff.get(), row.data(), std::uint32_t(y)) >= 0;
        }
        good = good && TIFFFlush(tiff.get()) != 0;
    }
    if (!good || memory.isUsedUp)
        throw protocols::environmentFault(
            {"cannot be encoded (" + (memory.isUsedUp ? "the memory is used up" : memory.message) + ")", file.string(),
             "enough memory", "close other programs and try again"});
    protocols::writeWholeFile(file, memory.bytes, sync);
}

}  // namespace rendering
