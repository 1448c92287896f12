#include "rendering/scans/stated_resolution.h"

#include <cstdint>

namespace rendering::scans {

namespace {

constexpr double inchesPerMetre = 1 / 0.0254, inchesPerCm = 1 / 2.54;

/// Numbers in a header; 0 beyond its end.
class Header {
public:
    Header(std::string_view bytes, bool isLittleEndian) : m_bytes(bytes), m_isLittleEndian(isLittleEndian) {}

    std::uint32_t number(std::size_t at, int size) const
    {
        std::uint32_t value = 0;
        if (at > m_bytes.size() || m_bytes.size() - at < static_cast<std::size_t>(size)) return 0;
        for (int i = 0; i < size; ++i) {
            const auto byte =
                static_cast<unsigned char>(m_bytes[at + static_cast<std::size_t>(m_isLittleEndian ? size - 1 - i : i)]);
            value = value << 8 | byte;
        }
        return value;
    }

private:
    std::string_view m_bytes;
    bool m_isLittleEndian;
};

std::optional<StatedResolution> inExif(std::string_view tiff)
{
    if (!tiff.starts_with("II") && !tiff.starts_with("MM")) return {};
    constexpr std::uint32_t xResolution = 0x011a, resolutionUnit = 0x0128;
    const Header header(tiff, tiff.starts_with("II"));
    const std::size_t directory = header.number(4, 4), entries = header.number(directory, 2);
    double perUnit = 0;
    std::uint32_t unit = 0;
    for (std::size_t i = 0; i < entries && directory + 14 + 12 * i <= tiff.size(); ++i) {
        const std::size_t entry = directory + 2 + 12 * i;
        if (header.number(entry, 2) == resolutionUnit) unit = header.number(entry + 8, 2);
        if (header.number(entry, 2) != xResolution) continue;
        const std::size_t at = header.number(entry + 8, 4);
        const double below = header.number(at + 4, 4);
        perUnit = below > 0 ? header.number(at, 4) / below : 0;
    }
    if (!(perUnit > 0)) return {};
    return StatedResolution{unit == 3 ? perUnit / inchesPerCm : perUnit, unit == 2 || unit == 3, 0};
}

std::optional<StatedResolution> inJpeg(std::string_view bytes)
{
    const Header header(bytes, false);
    std::optional<StatedResolution> exif, jfif;
    int width = 0;
    for (std::size_t at = 2; at + 4 <= bytes.size() && header.number(at, 1) == 0xff;) {
        const std::uint32_t marker = header.number(at + 1, 1), length = header.number(at + 2, 2);
        if (marker == 0xda || length < 2) break;
        const std::string_view body = bytes.substr(at + 4, length - 2);
        const bool isFrame = marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
        if (isFrame) width = static_cast<int>(header.number(at + 7, 2));
        if (marker == 0xe1 && body.starts_with(std::string_view("Exif\0\0", 6))) exif = inExif(body.substr(6));
        if (marker == 0xe0 && body.starts_with("JFIF")) {
            const std::uint32_t unit = header.number(at + 11, 1);
            const double density = header.number(at + 12, 2);
            if ((unit == 1 || unit == 2) && density > 0)
                jfif = StatedResolution{unit == 2 ? density / inchesPerCm : density, true, 0};
        }
        at += 2 + length;
    }
    std::optional<StatedResolution> stated = exif ? exif : jfif;
    if (stated) stated->widthPx = width;
    return stated;
}

std::optional<StatedResolution> inPng(std::string_view bytes)
{
    const Header header(bytes, false);
    for (std::size_t at = 8; at + 12 <= bytes.size();) {
        const std::size_t length = header.number(at, 4);
        const std::string_view kind = bytes.substr(at + 4, 4);
        if (kind == "IDAT") break;
        if (kind == "pHYs" && header.number(at + 16, 1) == 1 && header.number(at + 8, 4) > 0)
            return StatedResolution{header.number(at + 8, 4) / inchesPerMetre, true, static_cast<int>(header.number(16, 4))};
        at += 12 + length;
    }
    return {};
}

}  // namespace

std::optional<StatedResolution> statedResolution(std::string_view bytes)
{
    if (bytes.starts_with("\xff\xd8")) return inJpeg(bytes);
    if (bytes.starts_with("\x89PNG\r\n\x1a\n")) return inPng(bytes);
    return {};
}

}  // namespace rendering::scans
