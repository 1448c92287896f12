// The resolution that an image file states in its header: EXIF or JFIF of a JPEG, pHYs of a PNG.
#pragma once

#include <optional>
#include <string_view>

namespace rendering::scans {

struct StatedResolution {
    double perInch = 0;    ///< pixels
    bool hasUnit = false;  ///< false: EXIF without a unit, whose usual meaning is inches
    int widthPx = 0;       ///< of the image as it is shown
};

/// nullopt where the bytes state no resolution with a meaning, or are damaged.
std::optional<StatedResolution> statedResolution(std::string_view bytes);

}  // namespace rendering::scans
