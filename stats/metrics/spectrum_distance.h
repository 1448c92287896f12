// How far the frequency content of a generated trace lies from the true one's, whatever their phases.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "stats/kernels/value.h"

namespace stats {

/// Welch's (1967) power spectrum: Hann windows of `segment` values, half of them shared with the next,
/// each about its own mean. Entry i belongs to the frequency i / segment per value, 0 <= i <= segment/2;
/// unnormalised. Empty where the trace is shorter than a segment or `segment` is below 4.
std::vector<double> powerSpectrum(std::span<const double> trace, std::size_t segment);

struct SpectrumDistance {
    std::string why;              ///< empty when it exists
    Value decibels;               ///< root mean square over the frequencies of 10 log10 of the ratio of powers
    Value bias;                   ///< mean of the same, generated over truth: an amplitude twice too large gives 6.02
    std::size_t frequencies = 0;  ///< compared; the mean (frequency 0) is not
};

/// The traces may differ in length. Refused with a reason: a trace shorter than the segment, values that
/// are not finite, a frequency without any power.
SpectrumDistance spectrumDistance(std::span<const double> generated, std::span<const double> truth, std::size_t segment = 64);

}  // namespace stats
