// What a photograph of a fabric looks like, in a few numbers: colour, contrast, spectrum and
// direction of its texture. Two photographs of one fabric lie near each other, whatever the place,
// the turn and the size; used for finding known photographs like it, and so what is remembered of their fabrics.
#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

namespace rendering::models {

inline constexpr int photographFeatureCount = 22;

/// Three of mean colour (brightness, red - green, yellow - blue), contrast and skewness of the grey
/// picture over its illumination, twelve shares of the power in third octaves of 1/2..1/32 cycles a
/// pixel (logarithms), one of its regularity, four of direction at two scales (without the angle).
/// `rgb`: CV_8UC3 of any size from 1 x 1; of a large picture 16 tiles of 128 px are looked at, a small
/// one is mirrored. Always finite; scaled so that Euclidean distances make sense. Throws badInput for
/// another kind of picture.
std::vector<float> photographFeatures(const cv::Mat& rgb);

}  // namespace rendering::models
