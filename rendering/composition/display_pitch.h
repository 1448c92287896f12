// Resampling of a source to the display's pitch of 0.170 mm per pixel, without aliasing.
#pragma once

#include <opencv2/core/mat.hpp>

namespace rendering {

/// A source at the display's pitch.
struct AtDisplayPitch {
    cv::Mat values;        ///< CV_32FC1, at most as large as `most`; a larger result is cropped to its middle
    bool cropped = false;  ///< true where the result was cropped
};

/// `source`: CV_32FC1 with one pitch. A Lanczos filter of three lobes suppresses aliasing when a source becomes smaller;
/// waves of three new pixels and more stay unchanged. A trace (`bothAxes` false) is scaled along x only. Sources of any
/// size take bounded time, because finer ones are first averaged in whole pixels.
AtDisplayPitch atDisplayPitch(const cv::Mat& source, double mmPerPixel, bool bothAxes, cv::Size most);

}  // namespace rendering
