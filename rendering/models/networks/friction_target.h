// Between a friction trace and what G_s speaks: the spectrogram's magnitudes as the logarithm of
// their ratio to what the mean alone would give, and the mean friction as its own number. So
// slipperiness and texture are learnt apart, and the mean cannot get lost in an inverse transform.
#pragma once

#include <opencv2/core/mat.hpp>
#include <span>
#include <vector>

#include "rendering/models/architecture.h"
#include "rendering/signals/spectrogram.h"

namespace rendering::models {

struct FrictionTarget {
    cv::Mat logRatio;  ///< CV_32FC1 [rows x frames]: log(|STFT(f)| / (mean x sum of the window) + ratioFloor)
    float mean = 0;    ///< coefficient of friction
};

inline constexpr double ratioFloor = 1e-4;

/// The shape of the spectrogram of a trace of `traceSamples` samples, into rows and frames.
void setSpectrogramShape(Architecture& architecture);

/// Of the spectrograms that G_s speaks; the rate in samples a millimetre: the same law, no speed in it.
signals::SpectrogramParameters spectrogramParameters(const Architecture& architecture);

/// `trace` is cut or mirrored to Architecture::traceSamples. Needs a positive mean (badInput else).
FrictionTarget frictionTarget(std::span<const double> trace, const Architecture& architecture);

/// CV_32FC1 [rows x frames] magnitudes, the DC row scaled so that its average is that of `mean`.
cv::Mat magnitudes(const FrictionTarget& target, const Architecture& architecture);

/// Griffin-Lim of the texture in magnitudes(target), the rows that the mean does not reach; its mean is exactly the target's.
std::vector<double> traceOf(const FrictionTarget& target, const Architecture& architecture, int iterations);

}  // namespace rendering::models
