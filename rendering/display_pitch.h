// A source at the display's own pitch: 0.170 mm per pixel, without what the display cannot hold.
#pragma once

#include <opencv2/core/mat.hpp>

namespace rendering {

/// What a source is at the display's pitch, centre on centre.
struct AtDisplayPitch {
    cv::Mat values;        ///< CV_32FC1, at most `most` large; the middle where there would be more
    bool cropped = false;  ///< there would be more
};

/// `source`: CV_32FC1 of one pitch. Made smaller, it first passes a Gaussian of half a new pixel, which
/// leaves under 1 % of what the new pixels cannot hold. A trace (`bothAxes` false) is scaled along x alone.
/// Sources of any size take bounded time: finer ones are first averaged in whole pixels.
AtDisplayPitch atDisplayPitch(const cv::Mat& source, double mmPerPixel, bool bothAxes, cv::Size most);

}  // namespace rendering
