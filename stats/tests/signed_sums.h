// Exact distribution of a sum whose terms have random signs, for Wilcoxon's signed-rank test and the sign-flip
// permutation test. It is computed by dynamic programming, one term after another.
#pragma once

#include <span>

#include "stats/kernels/distributions.h"
#include "stats/tests/t_tests.h"

namespace stats {

/// Limits: beyond them the tails fall below the smallest double, or the computation takes too long.
constexpr std::size_t mostSignedTerms = 1000;
constexpr double mostSignedWork = 2e9;  ///< number of terms x their sum, divided by their common divisor

/// True where the terms are within both limits.
bool signedSumIsFeasible(std::span<const long long> magnitudes);

/// P that the sum of the positive terms is at least (Greater) or at most (Less) `positive`, or as far from its
/// mean (TwoSided). `magnitudes` > 0, and feasible.
TailProbability signedSumProbability(std::span<const long long> magnitudes, long long positive, Tail tail);

}  // namespace stats
