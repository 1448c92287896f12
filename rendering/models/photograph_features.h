// Features of a photograph of a fabric: colour, contrast, and the spectrum and direction of its texture. Photographs of
// one fabric have similar features, independent of place, rotation and size of the picture. They find similar known
// photographs and thereby similar fabrics.
#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

namespace rendering::models {

/// Features, in order: mean colour (brightness, red - green, yellow - blue), then contrast and skewness of the grey picture
/// over its illumination. Then follow the logarithms of twelve shares of power in third octaves, from 1/32 to 1/2 cycles
/// per pixel. The last five describe regularity (one) and direction at two scales (four, without the angle). `rgb`: CV_8UC3
/// of any size from 1 x 1. At most 16 tiles of 128 px of a large picture are used; a small one is mirrored. Always finite
/// and scaled for Euclidean distances. Throws badInput for another type.
std::vector<float> photographFeatures(const cv::Mat& rgb);

}  // namespace rendering::models
