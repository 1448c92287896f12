// Measured heights and strokes brought to the pixels and the spacing that the networks work at. NaN marks points without a
// measurement, here and in every result. No torch here.
#pragma once

#include <opencv2/core/mat.hpp>

#include "rendering/signals/friction_trace.h"

namespace rendering::models {

/// The pixels that a height map is brought to. Both maps have the same centre.
struct PixelGrid {
    cv::Size size;
    double mmPerPixel = 0.05;
    double turnDeg = 0;  ///< rotation of the fabric in the picture minus that in the height map, anticlockwise
};

/// Height map of a press on the pixels of an aligned photograph, CV_32FC1; NaN outside the press.
cv::Mat onPhotograph(const cv::Mat& heightMm, double mmPerPixel, const PixelGrid& photograph);

/// A map scaled by a factor, averaged where it shrinks. A pixel of which less than half was measured is NaN.
cv::Mat scaledHeights(const cv::Mat& map, double factor);

/// The map minus its Gaussian mean with standard deviation `sigmaPx` over measured points; NaN where nothing was measured.
cv::Mat withoutSlowHeights(const cv::Mat& map, double sigmaPx);

/// Standard deviation over the measured points; NaN where fewer than 100 are.
double deviationOf(const cv::Mat& map);

/// Correlation over the points that both maps have; NaN where fewer than 100 are, or a map is constant.
double correlationOfHeights(const cv::Mat& a, const cv::Mat& b);

/// Share of measured points, 0 to 1.
double measuredShare(const cv::Mat& map);

using signals::atSpacing;  // of strokes

}  // namespace rendering::models
