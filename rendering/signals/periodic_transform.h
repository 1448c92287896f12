// Fourier transform of real images whose borders meet (left with right, top with bottom), and its inverse, by pocketfft on
// one thread. Seamless tiles of scanned materials are such images.
#pragma once

#include <opencv2/core/mat.hpp>

namespace rendering::signals {

/// `values`: CV_32FC1, any size. Returns CV_32FC2 [rows x (columns / 2 + 1)], not normalised: the entries of the negative
/// frequencies along x are the conjugates of those of the positive ones.
cv::Mat fourierTransform(const cv::Mat& values);

/// Inverse of fourierTransform(): CV_32FC1 with `columns` columns.
cv::Mat inverseFourierTransform(const cv::Mat& spectrum, int columns);

/// Frequency of entry k along an axis of `length` samples, cycles per sample, from -1/2 to 1/2.
inline double fourierFrequency(int k, int length) { return double(2 * k > length ? k - length : k) / length; }

/// Frequency whose derivative is taken: 0 at the highest frequency of an even length, which has no sign.
inline double fourierSlopeFrequency(int k, int length) { return 2 * k == length ? 0 : fourierFrequency(k, length); }

}  // namespace rendering::signals
