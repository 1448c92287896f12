// One-way analysis of variance of independent groups.
#pragma once

#include <span>
#include <vector>

#include "stats/kernels/value.h"

namespace stats {

struct OneWayAnova {
    std::string why;  ///< empty when F exists
    std::size_t n = 0;
    std::size_t groups = 0;
    Value ssBetween;
    Value ssWithin;
    Value msBetween;
    Value msWithin;
    Value df1;
    Value df2;
    Value f;
    Value p;
    Value logP;
    Value rSquared;  ///< eta squared: between / total
    Value omegaSquared;
    Value residualSd;  ///< root of msWithin
};

/// Refused with a reason: fewer than 2 groups, an empty group, a value that is not finite, no more values
/// than groups, no variation within any group.
OneWayAnova oneWayAnova(const std::vector<std::vector<double>>& groups);

}  // namespace stats
