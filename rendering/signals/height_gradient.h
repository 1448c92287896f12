// Relief of the condition `gradient`: the squared gradient of the height, clipped, on a logarithmic scale.
// Electrovibration displays often use this measure of steepness.
#pragma once

#include <opencv2/core/mat.hpp>

namespace rendering::signals {

/// Clipping bounds of the slope. They are the same for every fabric, so that images of steep and gentle fabrics stay comparable.
struct GradientOptions {
    double leastSlope = 0.01;  ///< mm/mm, > 0
    double mostSlope = 1;      ///< mm/mm, > leastSlope
};

/// log10 of |grad h|^2 clipped to [leastSlope^2, mostSlope^2]; CV_32FC1 of the size of the height. Differences are central,
/// one-sided at the borders, and 0 across a single row or column. `heightMm`: CV_32FC1 or CV_64FC1, mm. Throws badInput
/// where the height is empty or not finite, and for a pitch or bounds that are not positive and increasing.
cv::Mat heightGradient(const cv::Mat& heightMm, double mmPerPixel, const GradientOptions& options = {});

}  // namespace rendering::signals
