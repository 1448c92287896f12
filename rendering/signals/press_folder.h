// A folder of ball presses: background.png (or reference.png), the untouched sensor, and every other picture a press, in the
// order of their names. Other files (lists, licences) are left alone.
#pragma once

#include <filesystem>
#include <functional>

#include "rendering/signals/ball_presses.h"

namespace rendering {

/// Reads pictures that image_io does not (JPEG ...); may be empty.
using Decode = std::function<cv::Mat(const std::filesystem::path&)>;

/// Throws badInput: no folder, no background, no press, an unreadable picture.
signals::BallPresses readBallPresses(const std::filesystem::path& folder, double ballRadiusMm, double mmPerPixel,
                                     const Decode& decodeOther = {});

/// By its ending, through image_io or `decodeOther`.
cv::Mat readPicture(const std::filesystem::path& file, const Decode& decodeOther);

}  // namespace rendering
