// Conversion of colour to grey with the weights of ITU-R BT.601, which OpenCV uses too.
#pragma once

#include <opencv2/core/mat.hpp>

namespace rendering::signals {

/// 0.299 R + 0.587 G + 0.114 B without rounding; CV_32FC1 in the range of the image (0 to 255 for 8 bits).
/// `image`: CV_8UC3 or CV_16UC3 in the order R, G, B, or one channel, which is only converted. Throws badInput for an empty
/// image or another number of channels.
cv::Mat grey(const cv::Mat& image);

}  // namespace rendering::signals
