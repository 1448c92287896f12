// Central differences around gaps. A central difference joins the two neighbours of a pixel, never the pixel itself: the image
// is four interleaved lattices, which only the one-sided differences at the borders join. Gaps cut these few joints, and each
// lattice into parts. So the parts are integrated one by one, and then joined robustly: between neighbouring pixels of two parts
// the mean of their slopes predicts the rise, and a part lies at the median of what all its pixels predict.
#pragma once

#include <opencv2/core/mat.hpp>

#include "rendering/signals/surface_integration.h"

namespace rendering::signals {

/// Height, CV_64FC1, mean 0. `slopes`: CV_64FC1, finite everywhere; a slope is measured where `knownX` or `knownY` (CV_8UC1) is
/// not 0, elsewhere it is continued from its surroundings. Measured parts keep their shape; only what lies between is bridged.
cv::Mat joinedLattices(const Slopes& slopes, const cv::Mat& knownX, const cv::Mat& knownY, const Pitch& pitch);

}  // namespace rendering::signals
