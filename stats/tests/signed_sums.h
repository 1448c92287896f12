// The distribution of a sum whose terms each get a fair coin's sign: what Wilcoxon's signed-rank test and
// the sign-flip permutation test share. Exact, by adding one term after another.
#pragma once

#include <span>

#include "stats/kernels/distributions.h"
#include "stats/tests/t_tests.h"

namespace stats {

/// Beyond these the distribution would lose its tails to the smallest double, or take too long.
constexpr std::size_t mostSignedTerms = 1000;
constexpr double mostSignedWork = 2e9;  ///< terms x their sum, after their common divisor was taken out

bool signedSumIsFeasible(std::span<const long long> magnitudes);

/// P of a sum of positive terms at least (Greater), at most (Less) or as far from its mean as (TwoSided)
/// `positive`. `magnitudes` > 0; feasible.
TailProbability signedSumProbability(std::span<const long long> magnitudes, long long positive, Tail tail);

}  // namespace stats
