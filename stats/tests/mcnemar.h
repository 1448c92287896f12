// McNemar's test of two paired proportions, from the discordant pairs.
#pragma once

#include "stats/kernels/value.h"

namespace stats {

struct McNemarTest {
    std::string why;  ///< empty when the test exists
    long long b = 0;  ///< success under the first condition only
    long long c = 0;  ///< success under the second only
    Value pExact;     ///< two-sided binomial test of b among b + c at 1/2; 1 where b + c = 0
    Value logPExact;
    Value logPMid;
    Value pMid;        ///< exact p minus the probability of the observed b
    Value chiSquared;  ///< (b - c)^2 / (b + c), 1 degree of freedom
    Value pChiSquared;
    Value chiSquaredCorrected;  ///< with Edwards' continuity correction (|b - c| - 1)^2 / (b + c)
    Value pChiSquaredCorrected;
};

/// Tests the discordant pairs. Refused with a reason: negative counts. With b + c = 0 only the exact p exists.
McNemarTest mcnemarTest(long long b, long long c);

}  // namespace stats
