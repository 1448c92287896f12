// The high-pass filter of heights in the cosine transform: Gaussian of ISO 16610-21, with free borders.
#pragma once

#include <opencv2/core/mat.hpp>

#include "rendering/signals/surface_integration.h"

namespace rendering::signals {

/// Share of each cosine coefficient that the filter passes, CV_64FC1 of the map's size, 0 to 1; half at a wave of `cutoffMm`.
/// Throws badInput where the cut-off is not above 0.
cv::Mat highPassShares(cv::Size size, const Pitch& pitch, double cutoffMm);

}  // namespace rendering::signals
