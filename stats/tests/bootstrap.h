// Bias-corrected and accelerated (BCa) bootstrap interval of a mean (Efron 1987). The resamples are drawn in
// blocks, each from its own stream: the number of threads changes no bit.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "stats/kernels/value.h"

namespace stats {

struct BootstrapOptions {
    std::size_t resamples = 10000;
    double confidence = 0.95;
    std::uint64_t seed = 1;
    unsigned threads = 1;  ///< 0: one for each core
};

struct BcaBootstrap {
    std::string why;  ///< empty when the interval exists
    std::size_t n = 0;
    Value estimate;       ///< mean
    Value standardError;  ///< SD of the resampled means
    Value bias;           ///< z0: normal quantile of the share of resamples below the mean; a tie counts half
    Value acceleration;   ///< from the jackknife: skewness of the mean / 6
    Interval ci;          ///< type-7 quantiles of the resampled means
};

/// BCa interval of the mean. Refused with a reason: fewer than 2 values, a value that is not finite, no variation, no resamples
/// or so few that all lie on one side, a confidence outside 0 to 1.
BcaBootstrap bcaBootstrapOfMean(std::span<const double> x, const BootstrapOptions& options = {});

}  // namespace stats
