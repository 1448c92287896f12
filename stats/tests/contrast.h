// An estimated mean or difference of means with its standard error, for the t tests and the equivalence tests.
// Numbers are in the power-of-two scale of the samples.
#pragma once

#include <span>
#include <string>

#include "stats/kernels/moments.h"
#include "stats/tests/t_tests.h"

namespace stats {

struct Contrast {
    std::string why;  ///< empty when it can be tested
    Moments first;    ///< moments of x, or of the differences (Paired)
    Moments second;   ///< moments of y (Student, Welch)
    double sdX = 0;   ///< SD of x in a paired contrast
    double sdY = 0;
    double sd = 0;  ///< SD of the sample or of the differences; pooled (Student)
    double se = 0;
    double df = 0;
    bool hasSpread = false;

    /// Estimate minus `reference`, both scaled, without cancellation.
    double estimateMinus(double reference) const;
    bool twoSamples = false;
};

/// The contrast of a kind; `scaled` holds x and, where the kind has a second sample, y.
Contrast contrastOf(TKind kind, const ScaledSamples& scaled);

/// The reason why no number can be computed: sample sizes, values that are not finite. Else empty.
std::string inputFault(TKind kind, std::span<const double> x, std::span<const double> y);

/// The second sample of the kind; empty for one sample.
std::span<const double> secondOf(TKind kind, std::span<const double> y);

}  // namespace stats
