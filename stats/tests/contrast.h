// An estimated mean or difference of means with its standard error: what the t tests and the
// equivalence tests share. Numbers are in the power-of-two scale of the samples.
#pragma once

#include <span>
#include <string>

#include "stats/kernels/moments.h"
#include "stats/tests/t_tests.h"

namespace stats {

struct Contrast {
    std::string why;  ///< empty when it can be tested
    Moments first;    ///< of x, or of the differences (Paired)
    Moments second;   ///< of y (Student, Welch)
    double sdX = 0;   ///< of the two samples of a paired contrast
    double sdY = 0;
    double sd = 0;  ///< of the sample or the differences; pooled (Student)
    double se = 0;
    double df = 0;
    bool hasEstimate = false;
    bool hasSpread = false;

    /// Estimate minus `reference`, both scaled, without cancellation.
    double estimateMinus(double reference) const;
    bool twoSamples = false;
};

/// `scaled` holds x, and y where the kind has one.
Contrast contrastOf(TKind kind, const ScaledSamples& scaled);

/// Reasons that forbid any number: sizes, values that are not finite.
std::string inputFault(TKind kind, std::span<const double> x, std::span<const double> y);

/// The second sample of the kind; empty for one sample.
std::span<const double> secondOf(TKind kind, std::span<const double> y);

}  // namespace stats
