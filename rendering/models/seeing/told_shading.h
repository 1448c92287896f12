// What the networks saw, joined with what the shading of a told lamp tells without any training (signals/linear_shading.h). The
// networks know cloth like that of their training. On other cloth under a told lamp, such as piles and loops, the physics of
// light sees more than they do. No torch here.
#pragma once

#include <opencv2/core/mat.hpp>

namespace rendering::models {

/// Relief of the networks plus that of the shading. The standard deviation of the added relief is at most half of the networks'.
/// It is less where little of the picture is shading, and 0 where chance explains the shading. The slow part (slow_relief.h) and
/// the deviation of the rest stay about those of the networks. `reliefPx`: CV_32FC1, px; `contrast`: CV_32FC1 of the same size
/// (linear_shading.h); `lightDeg`: 0 right, 90 top, anticlockwise. Pictures below signals::shadingWindowPx are returned as they
/// are.
cv::Mat withToldShading(const cv::Mat& reliefPx, const cv::Mat& contrast, double lightDeg);

}  // namespace rendering::models
