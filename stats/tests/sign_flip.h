// Permutation test of paired differences: were the two conditions exchangeable within each participant,
// every sign of a difference would be a fair coin. Exact over all 2^n signs, on the decimal grid of the
// data, where equal sums are equal.
#pragma once

#include "stats/tests/t_tests.h"

namespace stats {

struct SignFlipTest {
    std::string why;  ///< empty when the test exists
    std::size_t n = 0;
    std::size_t nZero = 0;  ///< differences of 0, whose sign does not matter
    Value meanDifference;
    Value p;
    Value logP;
};

/// Of the differences x - y; an empty y stands for zeros. Refused with a reason: no values, unequal
/// numbers, values that are not finite, all differences zero, and data on no grid that is coarse enough
/// (or, without a grid, more than 22 differences).
SignFlipTest signFlipTest(std::span<const double> x, std::span<const double> y, Tail tail = Tail::TwoSided);

}  // namespace stats
