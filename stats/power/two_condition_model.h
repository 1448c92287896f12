// The linear mixed model of the answers under two conditions alone, in closed form: what lmerTest makes of these answers. It is
// the reference for the claims, which rest on the differences of the two conditions.
#pragma once

#include "stats/claims/crossed_mean.h"

namespace stats {

/// Mean of a - b by the model y ~ condition + (1 | participant) + (1 | fabric) + (1 | participant:condition) +
/// (1 | fabric:condition): restricted maximum likelihood, Satterthwaite's degrees of freedom. Both tables are complete and of one
/// shape, with at least 2 participants and 2 fabrics. In balanced data the estimates are the mean squares of the differences and
/// of the sums, pooled where a variance would be negative (Thompson 1962, Ann. Math. Stat. 33(1), 273-289).
CrossedMean differenceByTwoConditionModel(const CrossedTable& a, const CrossedTable& b, StudentQuantiles& quantiles);

}  // namespace stats
