// A source at the display's own pitch: 0.170 mm per pixel, without what the display cannot hold.
#pragma once

#include <opencv2/core/mat.hpp>

namespace rendering {

/// What a source is at the display's pitch, centre on centre.
struct AtDisplayPitch {
    cv::Mat values;        ///< CV_32FC1, at most `most` large; the middle where there would be more
    bool cropped = false;  ///< there would be more
};

/// `source`: CV_32FC1 of one pitch. Filtered by Lanczos' kernel of three lobes: made smaller, nothing folds that
/// the new pixels cannot hold; waves of three new pixels and more stay as they are. A trace (`bothAxes` false) is scaled along x
/// alone. Sources of any size take bounded time: finer ones are first averaged in whole pixels.
AtDisplayPitch atDisplayPitch(const cv::Mat& source, double mmPerPixel, bool bothAxes, cv::Size most);

}  // namespace rendering
