// Colour to grey by the weights of ITU-R BT.601, which are OpenCV's.
#pragma once

#include <opencv2/core/mat.hpp>

namespace rendering::signals {

/// 0.299 R + 0.587 G + 0.114 B, not rounded. `image`: CV_8UC3 or CV_16UC3 in R, G, B order, or one
/// channel, which is only converted. Returns CV_32FC1 in the image's own range (0..255 for 8 bits).
/// Throws badInput for an empty image or another number of channels.
cv::Mat grey(const cv::Mat& image);

}  // namespace rendering::signals
