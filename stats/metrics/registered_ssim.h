// Structural similarity after a shift: a generated height map with the right texture is not wrong because it
// lies half a yarn beside the measured one. The shift is reported with the similarity.
#pragma once

#include "stats/metrics/image_metrics.h"

namespace stats {

struct RegisteredSsim {
    std::string why;         ///< empty when it exists
    Value ssim;              ///< similarity of the pixels that both images have after the shift
    int right = 0;           ///< pixels by which b lies to the right of a
    int down = 0;            ///< pixels by which b lies below a
    Value correlation;       ///< Pearson correlation of those pixels; the shift is where it is largest
    Value ssimUnregistered;  ///< similarity of the images without a shift
};

/// Searches all whole shifts of up to `mostShift` pixels in each direction; of equally good ones it takes the
/// shortest. Refused with a reason: what ssim() refuses, a shift that leaves less than a window, images
/// without any variation.
RegisteredSsim registeredSsim(const ImageView& a, const ImageView& b, double range, int mostShift,
                              const SsimOptions& options = {});

}  // namespace stats
