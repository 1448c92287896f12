// Two one-sided tests (TOST, Schuirmann 1987): is the mean, or the difference of means, inside bounds that were
// stated beforehand? A t test that finds no difference does not show that there is none; this test can. The
// two-sided t test against 0 stands beside it, and a verdict combines the two.
#pragma once

#include "stats/tests/t_tests.h"

namespace stats {

struct EquivalenceOptions {
    double low = -0.5;  ///< in the unit of the data, low < high
    double high = 0.5;
    double alpha = 0.05;
};

struct EquivalenceTest {
    std::string why;  ///< empty when the test exists
    std::size_t n = 0;
    std::size_t nSecond = 0;
    Value estimate;
    Value se;
    Value df;
    Value tLower;  ///< tests mean > low
    Value pLower;
    Value logPLower;
    Value tUpper;  ///< tests mean < high
    Value pUpper;
    Value logPUpper;
    Value p;  ///< the larger of the two
    Value logP;
    Interval ci;        ///< level 1 - 2 alpha; lies inside the bounds exactly when p < alpha
    Value tDifference;  ///< the two-sided test against 0
    Value pDifference;
    Value logPDifference;
    Value dZ;
    bool equivalent = false;
    bool different = false;

    /// One of four, such as "different / not shown equivalent", or "undefined: reason".
    std::string verdict() const;
};

EquivalenceTest equivalenceTest(TKind kind, std::span<const double> x, std::span<const double> y,
                                const EquivalenceOptions& options = {});

}  // namespace stats
