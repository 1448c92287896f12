// Wilcoxon's signed-rank test: exact with ties (the permutation distribution of the mid-ranks that
// occurred, by dynamic programming) and with the normal approximation beside it.
#pragma once

#include "stats/tests/t_tests.h"

namespace stats {

enum class ZeroMethod {
    Wilcox,  ///< zeros are dropped before ranking
    Pratt,   ///< zeros are ranked, then dropped
};
enum class Arithmetic {
    Double,   ///< differences as the machine subtracts them
    Decimal,  ///< differences on the decimal grid of the data, where 0.3 - 0.2 ties with 0.9 - 0.8
};

struct WilcoxonOptions {
    Tail tail = Tail::TwoSided;
    ZeroMethod zeros = ZeroMethod::Wilcox;
    Arithmetic arithmetic = Arithmetic::Decimal;  ///< data on no common grid fall back to Double
};

struct WilcoxonTest {
    std::string why;  ///< empty when the test exists
    std::size_t nUsed = 0;
    std::size_t nZero = 0;
    Value v;       ///< sum of the ranks of the positive differences
    Value pExact;  ///< undefined above 1000 differences: there read pNormal
    Value logPExact;
    Value z;  ///< without continuity correction
    Value pNormal;
    Value zCorrected;  ///< with the correction of 0.5 towards the mean
    Value pNormalCorrected;
    Value rankBiserial;   ///< (positive - negative rank sum) / total
    Value hodgesLehmann;  ///< median of the Walsh averages of all differences; undefined above 5000
};

/// Of the differences x - y; an empty y stands for zeros.
WilcoxonTest wilcoxonSignedRank(std::span<const double> x, std::span<const double> y, const WilcoxonOptions& options = {});

}  // namespace stats
