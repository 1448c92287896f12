// Permutation test of paired differences. If the two conditions are exchangeable within each participant, both
// signs of a difference are equally likely. Exact over all 2^n signs, on the decimal grid of the data, where
// equal sums are exactly equal.
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

/// Tests the differences x - y; an empty y stands for zeros. Refused with a reason: no values, unequal numbers,
/// values that are not finite, all differences zero, too fine a grid, more than 22 differences without a grid.
SignFlipTest signFlipTest(std::span<const double> x, std::span<const double> y, Tail tail = Tail::TwoSided);

}  // namespace stats
