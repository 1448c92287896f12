#include "study/looking/picture_decoder.h"

#include <QBuffer>
#include <QImageReader>
#include <QLoggingCategory>
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

/// A number of a BMP file, whose lowest byte stands first.
std::uint64_t bmpNumber(std::string_view bytes, std::size_t at, std::size_t length)
{
    std::uint64_t number = 0;
    for (std::size_t i = 0; i < length; ++i) number |= static_cast<std::uint64_t>(byteAt(bytes, at + i)) << (8 * i);
    return number;
}

/// Whether all rows of a BMP file are there. Rows that are compressed have no length of their own: they count as complete.
bool hasAllRowsOfBmp(std::string_view bytes)
{
    constexpr std::size_t headers = 54, windowsHeader = 40;
    if (bytes.size() < headers || bmpNumber(bytes, 14, 4) < windowsHeader) return true;  // Qt knows better
    const std::uint64_t start = bmpNumber(bytes, 10, 4), width = bmpNumber(bytes, 18, 4), bits = bmpNumber(bytes, 28, 2);
    const auto rows = static_cast<std::int32_t>(bmpNumber(bytes, 22, 4));  // below 0: the first row is the highest
    const std::uint64_t compression = bmpNumber(bytes, 30, 4);
    if (compression != 0 && compression != 3) return true;
    const std::uint64_t rowBytes = (width * bits + 31) / 32 * 4;
    return start + rowBytes * static_cast<std::uint64_t>(std::abs(static_cast<std::int64_t>(rows))) <= bytes.size();
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

/// The formats for a message; the formats of this computer's Qt differ with its plugins.
std::string readableFormats()
{
    const auto known = QImageReader::supportedImageFormats();
    return std::string("PNG, JPEG, BMP, GIF") + (known.contains("webp") ? ", PPM or WebP" : " or PPM");
}

}  // namespace

cv::Mat decodeByQt(const std::filesystem::path& file)
{
    // Qt would wait for ever where a pipe stands in the place of a picture.
    const std::string bytes = protocols::readRegularFile(file, largestPicture);
    requireWhole(bytes, file);
    QByteArray view = QByteArray::fromRawData(bytes.data(), static_cast<qsizetype>(bytes.size()));
    QBuffer buffer(&view);
    buffer.open(QIODevice::ReadOnly);
    QImageReader reader(&buffer);
    reader.setAutoTransform(true);
    QImageReader::setAllocationLimit(1024);  // MiB; enough for the largest camera pictures
    std::string reports;
    const JpegReports kept(reports);
    const QImage image = reader.read().convertToFormat(QImage::Format_RGB888);
    if (image.isNull())
        throw protocols::badInput({"the image cannot be read (" + reader.errorString().toStdString() + ")", file.string(),
                                   readableFormats(), "convert it to PNG"});
    requireSoundPixels(reports, file);
    const cv::Mat pixels(image.height(), image.width(), CV_8UC3, const_cast<uchar*>(image.constBits()),
                         static_cast<size_t>(image.bytesPerLine()));
    return pixels.clone();
}

}  // namespace study::looking
