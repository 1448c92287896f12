// Between a friction trace and what G_s speaks: the mean friction as a number of its own, and the
// spectrogram of what varies about it, as the logarithm of its magnitudes relative to the mean. So
// slipperiness and texture are learnt apart: texture is some hundredths of the mean, whose lobe in a
// spectrogram of the whole trace would drown it, and no inverse transform can lose the mean.
#pragma once

#include "rendering/models/architecture.h"

#include <opencv2/core/mat.hpp>

#include <span>
#include <vector>

namespace rendering::models {

struct FrictionTarget {
    cv::Mat logRatio;  ///< CV_32FC1 [rows x frames]: log(|STFT(f - mean)| / (mean x sum of the window) + ratioFloor)
    float mean = 0;    ///< coefficient of friction
};

inline constexpr double ratioFloor = 1e-4;

/// The shape of the spectrogram of a trace of `traceSamples` samples, into rows and frames.
void setSpectrogramShape(Architecture& architecture);

/// `trace` is cut or mirrored to Architecture::traceSamples. Needs a positive mean (badInput else).
FrictionTarget frictionTarget(std::span<const double> trace, const Architecture& architecture);

/// The mean, and about it the trace with the target's magnitudes (phase by Griffin-Lim). Waves longer
/// than the window, which have no phase to find, are left out.
std::vector<double> traceOf(const FrictionTarget& target, const Architecture& architecture, int iterations);

/// CV_32FC1 [rows x frames] magnitudes of a trace; its row of frequency 0 holds the mean.
cv::Mat spectrogramOf(std::span<const double> trace, const Architecture& architecture);

}  // namespace rendering::models
