// Numbers by which a photograph of cloth differs from other pictures: cloth fills the picture with one texture, so its parts are
// alike. Exposure, white balance and even dye shift logarithms by a constant and change none of them.
#pragma once

#include <array>
#include <opencv2/core/mat.hpp>

namespace rendering::models {

inline constexpr int clothFeatureCount = 22;
using ClothFeatures = std::array<double, clothFeatureCount>;

/// Of a picture CV_8UC3 (RGB) with sides of at least 1 px. Pictures above 1,536 px are reduced, those below 48 px enlarged. The
/// picture is cut into 2 x 2 to 6 x 6 parts. In the order of the result: how unevenly the parts hold contrast of four scales (4:
/// beside a slope over the picture; 4: in all), the median contrast (4), the least contrast of the three finest scales (3), how
/// unevenly the parts are bright (1) and coloured (2), how sparse fine contrast is (2), how much its direction varies (1), and
/// the share of pixels without any gradient (1).
ClothFeatures clothFeatures(const cv::Mat& rgb);

}  // namespace rendering::models
