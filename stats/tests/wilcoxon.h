// Wilcoxon's signed-rank test: exact p, also with ties (permutation distribution of the mid-ranks), and the normal
// approximation.
#pragma once

#include "stats/tests/t_tests.h"

namespace stats {

enum class ZeroMethod {
    Wilcox,  ///< zeros are dropped before ranking
    Pratt,   ///< zeros are ranked, then dropped
};
enum class Arithmetic {
    Double,   ///< differences of doubles
    Decimal,  ///< differences on the decimal grid of the data, where 0.3 - 0.2 ties with 0.9 - 0.8
};

struct WilcoxonOptions {
    Tail tail = Tail::TwoSided;
    ZeroMethod zeros = ZeroMethod::Wilcox;
    /// Without a common grid differences are those of doubles, and those that differ by rounding alone are zero or tied.
    Arithmetic arithmetic = Arithmetic::Decimal;
};

struct WilcoxonTest {
    std::string why;  ///< empty when the test exists
    std::size_t nUsed = 0;
    std::size_t nZero = 0;
    Value v;       ///< sum of the ranks of the positive differences
    Value pExact;  ///< undefined above 1000 differences: then read pNormal
    Value logPExact;
    Value z;  ///< without continuity correction
    Value pNormal;
    Value zCorrected;  ///< with the correction of 0.5 towards the mean
    Value pNormalCorrected;
    Value rankBiserial;   ///< (positive - negative rank sum) / total
    Value hodgesLehmann;  ///< median of the Walsh averages of all differences; undefined above 5000
};

/// Tests the differences x - y; an empty y stands for zeros.
WilcoxonTest wilcoxonSignedRank(std::span<const double> x, std::span<const double> y, const WilcoxonOptions& options = {});

}  // namespace stats
