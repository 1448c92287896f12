// Bayes factor of the one-sample (or paired) t test with a Cauchy prior on the effect size, after
// Jeffreys, Zellner and Siow: Rouder, Speckman, Sun, Morey and Iverson (2009).
#pragma once

#include <numbers>

#include "stats/kernels/value.h"

namespace stats {

struct JzsBayesFactor {
    std::string why;  ///< empty when it exists
    Value bf10;       ///< probability of the data under an effect / under no effect
    Value logBf10;    ///< natural logarithm
};

constexpr double mediumPriorWidth = std::numbers::sqrt2 / 2;

/// Bayes factor from t of n >= 2 values or pairs; `priorWidth`: scale of the Cauchy prior, > 0.
JzsBayesFactor jzsBayesFactor(double t, long long n, double priorWidth = mediumPriorWidth);

}  // namespace stats
