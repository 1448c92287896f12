#include "rendering/scans/stated_resolution.h"

#include <cstdint>

#include "rendering/images/exif.h"

namespace rendering::scans {

namespace {

constexpr double inchesPerMetre = 1 / 0.0254, inchesPerCm = 1 / 2.54;

/// Numbers in a header, the first byte the highest; 0 beyond its end.
class Header {
public:
    explicit Header(std::string_view bytes) : m_bytes(bytes) {}

    std::uint32_t number(std::size_t at, std::size_t size) const
    {
        std::uint32_t value = 0;
        if (at > m_bytes.size() || m_bytes.size() - at < size) return 0;
        for (std::size_t i = 0; i < size; ++i) value = value << 8 | static_cast<unsigned char>(m_bytes[at + i]);
        return value;
    }

private:
    std::string_view m_bytes;
};

/// What a picture states, and how it is turned when it is shown.
struct Exposure {
    std::optional<StatedResolution> resolution;
    bool isTurned = false;  ///< rows and columns are exchanged
};

Exposure inExif(std::string_view tiff)
{
    constexpr unsigned xResolution = 0x011a, yResolution = 0x011b, resolutionUnit = 0x0128, inches = 2, centimetres = 3;
    const Exif exif(tiff);
    Exposure found{{}, exif.orientation() >= 5};
    const auto across = exif.ratio(xResolution), down = exif.ratio(yResolution);
    const double perUnit = (found.isTurned && down ? down : across).value_or(0);
    if (!(perUnit > 0)) return found;
    const unsigned unit = exif.number(resolutionUnit).value_or(0);
    found.resolution =
        StatedResolution{unit == centimetres ? perUnit / inchesPerCm : perUnit, unit == inches || unit == centimetres, 0};
    return found;
}

std::optional<StatedResolution> inJpeg(std::string_view bytes)
{
    const Header header(bytes);
    Exposure exif;
    std::optional<StatedResolution> jfif;
    std::uint32_t width = 0, height = 0;
    for (std::size_t at = 2; at + 4 <= bytes.size() && header.number(at, 1) == 0xff;) {
        const std::uint32_t marker = header.number(at + 1, 1), length = header.number(at + 2, 2);
        if (marker == 0xda || length < 2) break;
        const std::string_view body = bytes.substr(at + 4, length - 2);
        const bool isFrame = marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
        if (isFrame) {
            height = header.number(at + 5, 2);
            width = header.number(at + 7, 2);
        }
        if (marker == 0xe1 && body.starts_with(std::string_view("Exif\0\0", 6))) exif = inExif(body.substr(6));
        if (marker == 0xe0 && body.starts_with("JFIF")) {
            const std::uint32_t unit = header.number(at + 11, 1);
            const double density = header.number(at + 12, 2);
            if ((unit == 1 || unit == 2) && density > 0)
                jfif = StatedResolution{unit == 2 ? density / inchesPerCm : density, true, 0};
        }
        at += 2 + length;
    }
    std::optional<StatedResolution> stated = exif.resolution ? exif.resolution : jfif;
    if (stated) stated->widthPx = static_cast<int>(exif.isTurned ? height : width);
    return stated;
}

std::optional<StatedResolution> inPng(std::string_view bytes)
{
    const Header header(bytes);
    std::uint32_t across = 0, down = 0;
    bool isTurned = false;
    for (std::size_t at = 8; at + 12 <= bytes.size();) {
        const std::size_t length = header.number(at, 4);
        const std::string_view kind = bytes.substr(at + 4, 4);
        if (kind == "pHYs" && header.number(at + 16, 1) == 1) {
            across = header.number(at + 8, 4);
            down = header.number(at + 12, 4);
        }
        if (kind == "eXIf") isTurned = Exif(bytes.substr(at + 8, length)).orientation() >= 5;
        at += 12 + length;
    }
    const std::uint32_t perMetre = isTurned ? down : across;
    if (perMetre == 0) return {};
    return StatedResolution{perMetre / inchesPerMetre, true, static_cast<int>(header.number(isTurned ? 20 : 16, 4))};
}

}  // namespace

std::optional<StatedResolution> statedResolution(std::string_view bytes)
{
    if (bytes.starts_with("\xff\xd8")) return inJpeg(bytes);
    if (bytes.starts_with("\x89PNG\r\n\x1a\n")) return inPng(bytes);
    return {};
}

}  // namespace rendering::scans
