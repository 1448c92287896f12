// A folder of ball presses: background.png or reference.png shows the untouched sensor, every other picture is a press,
// in order of name. Other files (lists, licences) are ignored.
#pragma once

#include <filesystem>
#include <functional>

#include "rendering/signals/tactile/press_location.h"

namespace rendering {

/// Decoder of pictures that image_io does not read (JPEG and others); may be empty.
using Decode = std::function<cv::Mat(const std::filesystem::path&)>;

/// Reads a folder. Throws badInput for a missing folder, background or press, and for an unreadable picture.
signals::BallPresses readBallPresses(const std::filesystem::path& folder, double ballRadiusMm, double mmPerPixel,
                                     const Decode& decodeOther = {});

/// Reads a picture through image_io, a TIFF also in colour, or, for other file endings, through `decodeOther`.
cv::Mat readPicture(const std::filesystem::path& file, const Decode& decodeOther);

}  // namespace rendering
