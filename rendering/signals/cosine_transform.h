// The orthonormal discrete cosine transform (DCT-II) of images of any size and its inverse, by pocketfft on one
// thread. It belongs to half-sample mirrored extension, that is to surfaces whose slope across the border is free
// (Neumann).
#pragma once

#include <opencv2/core/mat.hpp>

namespace rendering::signals {

/// `values`: CV_32FC1 or CV_64FC1; the result has the same size and depth.
cv::Mat cosineTransform(const cv::Mat& values);
cv::Mat inverseCosineTransform(const cv::Mat& coefficients);

/// Frequency of coefficient k along an axis of `length` samples `pitch` apart, cycles per unit of pitch.
inline double cosineFrequency(int k, int length, double pitch) { return k / (2.0 * length * pitch); }

}  // namespace rendering::signals
