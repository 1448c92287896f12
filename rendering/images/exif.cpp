#include "rendering/images/exif.h"

namespace rendering {

std::optional<std::uint32_t> Exif::unsignedAt(std::size_t at, std::size_t size) const
{
    if (at > m_tiff.size() || m_tiff.size() - at < size) return {};
    const bool isLittle = m_tiff.starts_with("II");
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < size; ++i)
        value = value << 8 | static_cast<unsigned char>(m_tiff[at + (isLittle ? size - 1 - i : i)]);
    return value;
}

/// Where the four bytes of the tag's value begin.
std::optional<std::size_t> Exif::valueOf(unsigned tag) const
{
    constexpr std::size_t entryBytes = 12, headBytes = 8;
    if (!m_tiff.starts_with("II") && !m_tiff.starts_with("MM")) return {};
    const auto directory = unsignedAt(4, 4);
    const auto entries = directory ? unsignedAt(*directory, 2) : std::nullopt;
    for (std::size_t i = 0; entries && i < *entries; ++i) {
        const std::size_t entry = std::size_t{*directory} + 2 + entryBytes * i;
        const auto found = unsignedAt(entry, 2);
        if (!found || entry + entryBytes > m_tiff.size()) break;
        if (*found == tag) return entry + headBytes;
    }
    return {};
}

std::optional<unsigned> Exif::number(unsigned tag) const
{
    const auto at = valueOf(tag);
    return at ? unsignedAt(*at, 2) : std::nullopt;
}

std::optional<double> Exif::ratio(unsigned tag) const
{
    const auto place = valueOf(tag);
    const auto at = place ? unsignedAt(*place, 4) : std::nullopt;
    if (!at) return {};
    const auto above = unsignedAt(*at, 4), below = unsignedAt(std::size_t{*at} + 4, 4);
    if (!above || !below || *below == 0) return {};
    return static_cast<double>(*above) / *below;
}

unsigned Exif::orientation() const
{
    constexpr unsigned orientationTag = 0x0112, upright = 1;
    const unsigned stated = number(orientationTag).value_or(upright);
    return stated >= 1 && stated <= 8 ? stated : upright;
}

}  // namespace rendering
