// Tests of several conditions on complete blocks that assume no normal distribution: Friedman's test of ranks and
// Cochran's Q of successes.
#pragma once

#include "stats/kernels/block_table.h"

namespace stats {

struct FriedmanTest {
    std::string why;  ///< empty when the test exists
    std::size_t blocks = 0;
    Value q;  ///< corrected for ties
    Value df;
    Value p;  ///< chi-squared approximation
    Value logP;
    Value kendallW;        ///< agreement of the blocks, 0 to 1
    Value imanDavenportF;  ///< undefined at perfect agreement
    Value fDf1;
    Value fDf2;
    Value fP;
    Value fLogP;
};

/// Values of a block that differ by rounding alone are ties.
FriedmanTest friedmanTest(const BlockTable& table);

struct CochranTest {
    std::string why;
    std::size_t blocks = 0;
    Value q;
    Value df;
    Value p;
    Value logP;
};

/// Cochran's Q of a table of 0 and 1.
CochranTest cochranTest(const BlockTable& table);

}  // namespace stats
