// Structural similarity of two images exactly as Wang, Bovik, Sheikh and Simoncelli (2004) define it:
// Gaussian window of 11 x 11 with sigma 1.5, K1 = 0.01, K2 = 0.03, moments of the population, mean
// over the windows that lie wholly inside.
#pragma once

#include <cstddef>
#include <span>

#include "stats/value.h"

namespace stats {

/// Row-major [height x width].
struct ImageView {
    std::span<const double> values;
    std::size_t width = 0;
    std::size_t height = 0;
};

struct Ssim {
    std::string why;  ///< empty when it exists
    Value mean;       ///< 1 exactly for equal images; between -1 and 1
    Value smallest;   ///< over the windows
    Value largest;
    std::size_t windowsAcross = 0;
    std::size_t windowsDown = 0;
};

/// `range` is L, the difference of the largest and the smallest possible value, > 0 and finite.
/// Refused with a reason: images that differ in shape or are smaller than the window, a pixel that is
/// not finite, a range that is not positive.
Ssim ssim(const ImageView& a, const ImageView& b, double range);

}  // namespace stats
