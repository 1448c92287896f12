// Orthonormal discrete cosine transform (DCT-II) of images of any size, and its inverse, by pocketfft on one thread.
// The transform implies half-sample mirror extension, which suits surfaces with free (Neumann) borders.
#pragma once

#include <opencv2/core/mat.hpp>

namespace rendering::signals {

/// `values`: CV_32FC1 or CV_64FC1. The result has the same size and depth.
cv::Mat cosineTransform(const cv::Mat& values);
cv::Mat inverseCosineTransform(const cv::Mat& coefficients);
/// The same along x only, every row by itself; the coefficients are multiplied by `factor`.
cv::Mat cosineTransformOfRows(const cv::Mat& values, double factor = 1);
cv::Mat inverseCosineTransformOfRows(const cv::Mat& coefficients);

/// Frequency of coefficient k along an axis of `length` samples at a distance of `pitch`; cycles per unit of pitch.
inline double cosineFrequency(int k, int length, double pitch) { return k / (2.0 * length * pitch); }

}  // namespace rendering::signals
