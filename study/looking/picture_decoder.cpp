#include "study/looking/picture_decoder.h"

#include <QBuffer>
#include <QImageReader>
#include <QLoggingCategory>
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <string>
#include <string_view>

#include "protocols/files/errors.h"
#include "protocols/files/whole_file.h"

namespace study::looking {

namespace {

constexpr std::uint64_t largestPicture = std::uint64_t{1} << 30;  ///< bytes; a camera's largest BMP has 0.4 GB
constexpr std::uint64_t mostPixels = std::uint64_t{1} << 28;      ///< as of a PNG
/// GIF repeats 4,095 pixels in 12 bits; codes of JPEG and BMP are longer. Small drawings may well be of one colour.
constexpr std::uint64_t mostPixelsPerByte = 4096, usualPixels = std::uint64_t{1} << 20;

std::uint8_t byteAt(std::string_view bytes, std::size_t at) { return static_cast<std::uint8_t>(bytes[at]); }

constexpr std::string_view jpegStart = "\xFF\xD8\xFF", bmpStart = "BM";

constexpr std::uint8_t endOfImage = 0xD9, startOfScan = 0xDA, firstRestart = 0xD0, lastRestart = 0xD7, loneMarker = 0x01;

/// Where the coded pixels that begin at `at` end: at the next marker that is none of theirs, or at the end of the file.
std::size_t endOfCodedPixels(std::string_view bytes, std::size_t at)
{
    for (; at + 1 < bytes.size(); ++at) {
        const std::uint8_t next = byteAt(bytes, at + 1);
        const bool isTheirs = next == 0 || next == 0xFF || (next >= firstRestart && next <= lastRestart);
        if (byteAt(bytes, at) == 0xFF && !isTheirs) return at;
    }
    return bytes.size();
}

/// Whether the marks of the file lead to the end of its first image. A preview is a part of a segment, and cameras append other
/// images after the end.
bool hasEndOfJpeg(std::string_view bytes)
{
    std::size_t at = 2;
    while (at + 1 < bytes.size()) {
        const std::uint8_t marker = byteAt(bytes, at + 1);
        if (byteAt(bytes, at) != 0xFF || marker == 0xFF) {  // bytes that fill up
            ++at;
            continue;
        }
        if (marker == endOfImage) return true;
        at += 2;
        if (marker == 0 || marker == loneMarker || (marker >= firstRestart && marker <= lastRestart)) continue;
        if (at + 2 > bytes.size()) return false;
        at += static_cast<std::size_t>(byteAt(bytes, at)) << 8 | byteAt(bytes, at + 1);
        if (marker == startOfScan) at = endOfCodedPixels(bytes, at);
    }
    return false;
}

/// What Qt's reader of JPEG files reports on this thread: it decodes damaged pixels all the same.
thread_local std::string* jpegReport = nullptr;
constexpr const char* jpegCategory = "qt.gui.imageio.jpeg";
QtMessageHandler handlerBefore = nullptr;

void takeJpegReport(QtMsgType type, const QMessageLogContext& context, const QString& text)
{
    if (jpegReport != nullptr && context.category != nullptr && std::strcmp(context.category, jpegCategory) == 0)
        *jpegReport += text.toStdString() + '\n';
    else if (handlerBefore != nullptr)
        handlerBefore(type, context, text);
}

QLoggingCategory::CategoryFilter filterBefore = nullptr;

/// No setting of the user's may hide these reports.
void keepJpegReports(QLoggingCategory* category)
{
    if (filterBefore != nullptr) filterBefore(category);
    if (std::strcmp(category->categoryName(), jpegCategory) == 0) category->setEnabled(QtWarningMsg, true);
}

/// Keeps the reports of this thread while it lives.
class JpegReports {
public:
    explicit JpegReports(std::string& reports)
    {
        static std::once_flag isInstalled;
        std::call_once(isInstalled, [] {
            handlerBefore = qInstallMessageHandler(takeJpegReport);
            filterBefore = QLoggingCategory::installFilter(keepJpegReports);
        });
        jpegReport = &reports;
    }
    ~JpegReports() { jpegReport = nullptr; }
    JpegReports(const JpegReports&) = delete;
    JpegReports& operator=(const JpegReports&) = delete;
};

/// Some cameras fill the end of the image up with a few bytes that mean nothing. Many are pixels that were lost.
bool isPadding(const std::string& line)
{
    constexpr unsigned mostBytes = 16;
    unsigned bytes = 0, marker = 0;
    return std::sscanf(line.c_str(), "Corrupt JPEG data: %u extraneous bytes before marker 0x%x", &bytes, &marker) == 2 &&
           marker == endOfImage && bytes <= mostBytes;
}

/// Other reports than these are of the header.
void requireSoundPixels(const std::string& reports, const std::filesystem::path& file)
{
    for (const char* fault : {"Corrupt JPEG data", "Premature end"}) {
        const std::size_t at = reports.find(fault);
        if (at == std::string::npos) continue;
        const std::string line = reports.substr(at, reports.find('\n', at) - at);
        if (isPadding(line)) continue;
        throw protocols::badInput({"is a damaged JPEG (" + line + ")", file.string(), "a JPEG whose pixels are all sound",
                                   "copy it from the camera again, or take the photograph again"});
    }
}

/// A number of a BMP file, whose lowest byte stands first; bytes beyond the end count as 0.
std::uint64_t bmpNumber(std::string_view bytes, std::size_t at, std::size_t length)
{
    std::uint64_t number = 0;
    for (std::size_t i = 0; i < length && at + i < bytes.size(); ++i)
        number |= static_cast<std::uint64_t>(byteAt(bytes, at + i)) << (8 * i);
    return number;
}

/// What a BMP file says of its rows.
struct BmpRows {
    std::uint64_t start = 0, width = 0, rows = 0, bits = 0, compression = 0;
};

/// As Qt reads it: a header of any other length than those of Windows and OS/2 2.x is the short one of the first version.
BmpRows bmpRows(std::string_view bytes)
{
    constexpr std::uint64_t fileHeader = 14, shortHeader = 12;
    const std::uint64_t stated = bmpNumber(bytes, 10, 4), header = bmpNumber(bytes, 14, 4);
    const std::uint64_t start = std::max(stated, fileHeader + shortHeader);
    if (header != 40 && header != 64 && header != 108 && header != 124)
        return {start, bmpNumber(bytes, 18, 2), bmpNumber(bytes, 20, 2), bmpNumber(bytes, 24, 2), 0};
    const auto rows = static_cast<std::int32_t>(bmpNumber(bytes, 22, 4));  // below 0: the first row is the highest
    return {start, bmpNumber(bytes, 18, 4), static_cast<std::uint64_t>(std::abs(static_cast<std::int64_t>(rows))),
            bmpNumber(bytes, 28, 2), bmpNumber(bytes, 30, 4)};
}

/// Whether all rows of a BMP file are there. Rows that are compressed have no length of their own: they count as complete.
bool hasAllRowsOfBmp(std::string_view bytes)
{
    const BmpRows bmp = bmpRows(bytes);
    if (bmp.compression != 0 && bmp.compression != 3) return true;
    const std::uint64_t rowBytes = (bmp.width * bmp.bits + 31) / 32 * 4;
    return bmp.start <= bytes.size() && (rowBytes == 0 || bmp.rows <= (bytes.size() - bmp.start) / rowBytes);
}

/// Qt fills what is missing of these files with grey or black and reports a success.
void requireWhole(std::string_view bytes, const std::filesystem::path& file)
{
    const char* format = bytes.starts_with(jpegStart) && !hasEndOfJpeg(bytes)     ? "JPEG"
                         : bytes.starts_with(bmpStart) && !hasAllRowsOfBmp(bytes) ? "BMP"
                                                                                  : nullptr;
    if (format == nullptr) return;
    throw protocols::badInput({std::string("is not a readable ") + format + " (the file is truncated)", file.string(),
                               std::string("a complete ") + format + " image", "copy or export it again"});
}

/// A few bytes may promise a picture that fills the memory. No photograph has fewer bytes for its pixels.
void requireBelievable(const QImageReader& reader, std::size_t bytes, const std::filesystem::path& file)
{
    const QSize size = reader.size();
    const bool hasShorterCodes = reader.format() == "webp";  // pixels of one colour need no bits
    const std::uint64_t pixels =
        static_cast<std::uint64_t>(std::max(0, size.width())) * static_cast<std::uint64_t>(std::max(0, size.height()));
    if (pixels <= mostPixels && (hasShorterCodes || pixels <= mostPixelsPerByte * bytes + usualPixels)) return;
    const std::string stated =
        std::to_string(size.width()) + " x " + std::to_string(size.height()) + " pixels in " + std::to_string(bytes) + " bytes";
    throw protocols::badInput({"has too many pixels for its bytes or for this program (" + stated + ")", file.string(),
                               "at most " + std::to_string(mostPixels) + " pixels, and bytes for them", "export it again"});
}

/// The pixels as R, G, B. A few rows at a time: a large picture has room in memory twice, not three times.
cv::Mat rgbOf(const QImage& image)
{
    constexpr int rowsAtOnce = 64;
    cv::Mat pixels(image.height(), image.width(), CV_8UC3);
    for (int top = 0; top < image.height(); top += rowsAtOnce) {
        const int rows = std::min(rowsAtOnce, image.height() - top);
        const QImage part = image.copy(0, top, image.width(), rows).convertToFormat(QImage::Format_RGB888);
        for (int row = 0; row < rows; ++row)
            std::memcpy(pixels.ptr(top + row), part.constScanLine(row), static_cast<std::size_t>(image.width()) * 3);
    }
    return pixels;
}

/// HEIF or AVIF, as telephones write; Qt reads them with a plugin.
bool isHeif(std::string_view bytes) { return bytes.substr(0, 8).ends_with("ftyp"); }

bool isWebp(std::string_view bytes) { return bytes.starts_with("RIFF") && bytes.substr(0, 12).ends_with("WEBP"); }

/// PBM, PGM or PPM: "P1" to "P6".
bool isPortableMap(std::string_view bytes)
{
    return bytes.size() > 2 && bytes[0] == 'P' && bytes[1] >= '1' && bytes[1] <= '6' &&
           std::string_view(" \t\r\n#").find(bytes[2]) != std::string_view::npos;
}

/// Whether the content is of a format of photographs, whatever the name of the file says. Qt reads more: drawings that are
/// program text, and icons.
bool isOfPhotographs(std::string_view bytes)
{
    constexpr std::string_view starts[] = {jpegStart, bmpStart, "\x89PNG\r\n\x1A\n", "GIF87a", "GIF89a"};
    return std::ranges::any_of(starts, [&](std::string_view start) { return bytes.starts_with(start); }) || isWebp(bytes) ||
           isHeif(bytes) || isPortableMap(bytes);
}

/// The formats for a message; the formats of this computer's Qt differ with its plugins.
std::string readableFormats()
{
    const auto known = QImageReader::supportedImageFormats();
    return std::string("PNG, JPEG, BMP, GIF") + (known.contains("webp") ? ", PPM, PGM, PBM or WebP" : ", PPM, PGM or PBM");
}

}  // namespace

cv::Mat decodeByQt(const std::filesystem::path& file)
{
    // Qt would wait for ever where a pipe stands in the place of a picture.
    const std::string bytes = protocols::readRegularFile(file, largestPicture);
    if (!isOfPhotographs(bytes))
        throw protocols::badInput(
            {"the content is of none of the formats of photographs", file.string(), readableFormats(), "convert it to PNG"});
    requireWhole(bytes, file);
    QByteArray view = QByteArray::fromRawData(bytes.data(), static_cast<qsizetype>(bytes.size()));
    QBuffer buffer(&view);
    buffer.open(QIODevice::ReadOnly);
    QImageReader reader(&buffer);
    reader.setAutoTransform(true);
    QImageReader::setAllocationLimit(1024);  // MiB; enough for the largest camera pictures
    std::string reports;
    const JpegReports kept(reports);
    requireBelievable(reader, bytes.size(), file);
    const QImage image = reader.read();
    if (image.isNull())
        throw protocols::badInput({"the image cannot be read (" + reader.errorString().toStdString() + ")", file.string(),
                                   readableFormats(), "convert it to PNG"});
    requireSoundPixels(reports, file);
    return rgbOf(image);
}

}  // namespace study::looking
