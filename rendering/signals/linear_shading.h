// Relief from the shading of one lamp whose side is known, however the cloth is dyed. No training: the photograph itself tells
// how much of each frequency is shading and how much is dye.
//
// Under a lamp at the side l, slopes along l change the brightness, and slopes across l do not (Pentland, "Linear shape from
// shading", 1990). So the power of shading goes with the squared cosine of the angle to l, and that of dye does not: at each
// spatial frequency, the powers of all directions are fitted by D + S cos^2. A Wiener filter with these powers inverts the
// shading as far as it exceeds the dye. The power of a direction is a median, because a weave puts much power into few waves.
#pragma once

#include <opencv2/core/mat.hpp>

namespace rendering::signals {

/// Least side of a picture, px; waves longer than this are judged with this one.
inline constexpr int shadingWindowPx = 64;

struct LinearShading {
    cv::Mat relief;           ///< CV_32FC1, height in pixels over the tangent of the lamp's elevation, arbitrary zero
    double shadingShare = 0;  ///< share of shading in the power of the picture, mean over the octaves from 2 to 64 px; 0 to 1
};

/// `contrast`: CV_32FC1, finite, natural logarithm of brightness without that of the surroundings, sides of at least
/// shadingWindowPx. `lightDeg`: side of the lamp, 0 right, 90 top, anticlockwise. A uniform picture gives flat relief and share
/// 0. Throws badInput for a smaller picture.
LinearShading linearShading(const cv::Mat& contrast, double lightDeg);

}  // namespace rendering::signals
