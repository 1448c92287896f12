// Structural similarity of two images exactly as Wang, Bovik, Sheikh and Simoncelli (2004) define it:
// Gaussian window of 11 x 11 with sigma 1.5, K1 = 0.01, K2 = 0.03, moments of the population, mean
// over the windows that lie wholly inside. Other variants are chosen by options.
#pragma once

#include <cstddef>
#include <span>

#include "stats/kernels/value.h"

namespace stats {

/// Pixels, row-major [height x width].
template <typename Pixel>
struct BasicImageView {
    std::span<const Pixel> values;
    std::size_t width = 0;
    std::size_t height = 0;
};
using ImageView = BasicImageView<double>;
using FloatImageView = BasicImageView<float>;

enum class SsimWindow {
    Gaussian11,  ///< 11 x 11, sigma 1.5
    Uniform7,    ///< 7 x 7 box
};

struct SsimOptions {
    SsimWindow window = SsimWindow::Gaussian11;
    bool sampleMoments = false;  ///< variances with divisor N - 1, N pixels in a window
    double k1 = 0.01;
    double k2 = 0.03;
};

struct Ssim {
    std::string why;  ///< empty when it exists
    Value mean;       ///< 1 exactly for equal images; between -1 and 1
    Value smallest;   ///< smallest value of a window
    Value largest;
    std::size_t windowsAcross = 0;
    std::size_t windowsDown = 0;
};

/// Structural similarity. `range` is L, the difference of the largest and the smallest possible value, > 0.
/// Refused with a reason: images that differ in shape or are smaller than the window, a pixel that is
/// not finite, a range that is not positive, K1 or K2 that are not positive.
Ssim ssim(const ImageView& a, const ImageView& b, double range, const SsimOptions& options = {});

/// The same in 32-bit arithmetic: twice as fast, with an error below 1e-5 for images within their range.
Ssim ssim(const FloatImageView& a, const FloatImageView& b, double range, const SsimOptions& options = {});

}  // namespace stats
