// Relief from the shading of one lamp whose side is known, on cloth that is dyed, too. No training: the photograph itself tells
// how much of each frequency is shading and how much is dye.
//
// Under a lamp at the side l, slopes along l change the brightness, and slopes across l do not (Pentland, "Linear shape from
// shading", 1990). So the power of shading goes with the squared cosine of the angle to l. Dye is taken to have the same power in
// all directions; stripes of dye that run across l are taken for shading. At each spatial frequency, the powers of all directions
// are fitted by D + S cos^2. The power of a direction is a median, because a weave puts much power into few waves. A Wiener
// filter with these powers inverts the shading as far as it exceeds the dye.
#pragma once

#include <opencv2/core/mat.hpp>

namespace rendering::signals {

/// Least side of a picture, px. The share of shading in longer waves is taken from waves of this length.
inline constexpr int shadingWindowPx = 64;

struct LinearShading {
    /// CV_32FC1, arbitrary zero. Times the tangent of the lamp's elevation it is height in pixels.
    cv::Mat relief;
    double shadingShare = 0;  ///< share of shading in the power of the picture, mean over the octaves from 2 to 64 px; 0 to 1
    /// Nine of ten pictures of this size without any shading, whose dye has no direction, have a smaller share.
    double chanceShare = 1;
};

/// `contrast`: CV_32FC1, finite, natural logarithm of brightness without that of the surroundings, sides of at least
/// shadingWindowPx. `lightDeg`: side of the lamp, 0 right, 90 top, anticlockwise. A uniform picture gives flat relief and share
/// 0. Throws badInput for a smaller picture.
LinearShading linearShading(const cv::Mat& contrast, double lightDeg);

}  // namespace rendering::signals
