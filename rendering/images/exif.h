// Tags of Exif data, which are a small TIFF file inside a picture.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace rendering {

/// The first directory of Exif data. What lies beyond the end of the bytes reads as absent.
class Exif {
public:
    /// `tiff` begins with II or MM; other bytes have no tags.
    explicit Exif(std::string_view tiff) : m_tiff(tiff) {}

    /// A tag of type SHORT.
    std::optional<unsigned> number(unsigned tag) const;

    /// A tag of type RATIONAL; nullopt where the denominator is 0.
    std::optional<double> ratio(unsigned tag) const;

    /// How the picture is to be shown: 1 to 8, and 1 where none is stated. From 5 on rows and columns are exchanged.
    unsigned orientation() const;

private:
    std::optional<std::uint32_t> unsignedAt(std::size_t at, std::size_t size) const;
    std::optional<std::size_t> valueOf(unsigned tag) const;

    std::string_view m_tiff;
};

}  // namespace rendering
