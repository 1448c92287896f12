// The relief of the condition `gradient`: how steep the surface is, as electrovibration displays are
// often fed - the squared gradient of the height, clipped, on a logarithmic scale.
#pragma once

#include <opencv2/core/mat.hpp>

namespace rendering::signals {

/// Slopes below `least` are flat and above `most` a wall. The bounds are the same for every fabric, so
/// that images of a steep and of a gentle one stay comparable.
struct GradientOptions {
    double leastSlope = 0.01;  ///< mm/mm, > 0
    double mostSlope = 1;      ///< mm/mm, > leastSlope
};

/// log10 of |grad h|^2 clipped to [least^2, most^2], so from 2 log10(least) to 2 log10(most); CV_32FC1 of
/// the height's size. Differences are central, one-sided at the borders, 0 across a single row or column.
/// `heightMm`: CV_32FC1 or CV_64FC1, mm. Throws badInput where it is empty or not finite, for a pitch that
/// is not above 0, and for bounds that are no range.
cv::Mat heightGradient(const cv::Mat& heightMm, double mmPerPixel, const GradientOptions& options = {});

}  // namespace rendering::signals
