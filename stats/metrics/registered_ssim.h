// Structural similarity after a shift: a generated height map of the right texture that lies half a yarn
// beside the measured one is not wrong. The shift is reported with it, never hidden.
#pragma once

#include "stats/metrics/image_metrics.h"

namespace stats {

struct RegisteredSsim {
    std::string why;         ///< empty when it exists
    Value ssim;              ///< of the pixels that both images have after the shift
    int right = 0;           ///< pixels by which b lies right of a
    int down = 0;            ///< and below it
    Value correlation;       ///< of those pixels; the shift is where it is largest
    Value ssimUnregistered;  ///< of the images as they are
};

/// Searches all whole shifts of up to `mostShift` pixels in each direction; of equally good ones the
/// shortest is taken. Refused with a reason: what ssim() refuses, a shift that leaves less than a window,
/// images without any variation.
RegisteredSsim registeredSsim(const ImageView& a, const ImageView& b, double range, int mostShift,
                              const SsimOptions& options = {});

}  // namespace stats
