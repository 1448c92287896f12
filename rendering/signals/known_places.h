// Continuation of an image where some of its values are missing.
#pragma once

#include <opencv2/core/mat.hpp>

namespace rendering::signals {

/// Replaces values at places where `known` (CV_8UC1) is 0 by the mean of the nearest known ones, through a pyramid of averages.
/// `values`: CV_32FC1 or CV_64FC1; the result is a new image of its depth.
cv::Mat continued(const cv::Mat& values, const cv::Mat& known);

}  // namespace rendering::signals
