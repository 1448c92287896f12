// Distance between the power spectra of a generated and a true trace; phases do not matter.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "stats/kernels/value.h"

namespace stats {

/// Welch's (1967) power spectrum: Hann windows of `segment` values that overlap by half, each about its own mean.
/// Entry i is the power at frequency i / segment per value, 0 <= i <= segment/2, not normalised. Empty where the
/// trace is shorter than a segment or `segment` is below 4.
std::vector<double> powerSpectrum(std::span<const double> trace, std::size_t segment);

struct SpectrumDistance {
    std::string why;              ///< empty when it exists
    Value decibels;               ///< root mean square over the frequencies of 10 log10(generated power / true power)
    Value bias;                   ///< mean over the frequencies of the same; twice the amplitude gives 6.02
    std::size_t frequencies = 0;  ///< number of frequencies compared; the mean (frequency 0) is left out
};

/// Compares two traces, which may differ in length. Refused with a reason: a trace shorter than the segment, values that
/// are not finite, a frequency without any power.
SpectrumDistance spectrumDistance(std::span<const double> generated, std::span<const double> truth, std::size_t segment = 64);

}  // namespace stats
