// Conversion between a friction trace and the two outputs of G_s. One is the mean friction. The other is the logarithm of
// the spectrogram's magnitudes over those of the mean alone. So slipperiness and texture are learnt separately, and an
// inverse transform cannot change the mean.
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

/// Sets rows and frames of the spectrogram of a trace of `traceSamples` samples.
void setSpectrogramShape(Architecture& architecture);

/// Parameters of G_s's spectrograms. The rate is in samples per millimetre, so that they do not depend on speed.
signals::SpectrogramParameters spectrogramParameters(const Architecture& architecture);

/// Target for a trace, which is cut or mirrored to Architecture::traceSamples. Throws badInput for a mean that is not positive.
FrictionTarget frictionTarget(std::span<const double> trace, const Architecture& architecture);

/// Magnitudes, CV_32FC1 [rows x frames]. The row of frequency 0 is scaled to the average of a trace with the target's mean.
cv::Mat magnitudes(const FrictionTarget& target, const Architecture& architecture);

/// Trace by Griffin-Lim from the rows of magnitudes(target) that the mean does not reach; its mean is exactly the target's.
std::vector<double> traceOf(const FrictionTarget& target, const Architecture& architecture, int iterations);

}  // namespace rendering::models
