// What JPEG takes from a picture: quantised cosine coefficients of 8 × 8 blocks, and colour at half the resolution.
#pragma once

#include <opencv2/core/mat.hpp>

namespace rendering::fabrics {

/// The picture after one compression with `quality` 1 to 100 (tables of ITU-T T.81, annex K, scaled as libjpeg does).
/// CV_8UC3, red first.
cv::Mat afterJpeg(const cv::Mat& rgb, int quality);

}  // namespace rendering::fabrics
