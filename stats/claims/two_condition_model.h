// The difference of two conditions by the linear mixed model of the answers under these two alone. It is the model that lmerTest
// fits; complete tables have a closed form.
#pragma once

#include "stats/claims/crossed_mean.h"

namespace stats {

/// Differences a - b of two tables of one shape. Those that are equal but for rounding get one value: they have no variation.
CrossedTable evenDifferences(const CrossedTable& a, const CrossedTable& b);

/// Mean of a - b by the model y ~ condition + (1 | participant) + (1 | fabric) + (1 | participant:condition) +
/// (1 | fabric:condition): restricted maximum likelihood, Satterthwaite's degrees of freedom. Both tables are complete and of one
/// shape, with at least 2 participants and 2 fabrics. In balanced data the estimates are the mean squares of the differences and
/// of the sums, pooled where a variance would be negative (Thompson 1962, Ann. Math. Stat. 33(1), 273-289). The refusals are
/// those of crossedMean() of the differences.
CrossedMean differenceByTwoConditionModel(const CrossedTable& a, const CrossedTable& b, StudentQuantiles& quantiles);

/// What the report claims of two conditions whose answers are ratings. FabricsLikeThese: the model of the two conditions, with
/// at most mostDegrees() of the differences if `degrees` says so. It knows the residual from the sums as well, which the
/// differences alone do not. A table with gaps has no closed form: there, and for TheseFabrics, the result is that of
/// crossedMean() of the differences. So it is where the ratings of a condition are all equal: sums and differences then are the
/// same answers, which the model of both conditions would count twice. Participants and fabrics without any answer under both
/// conditions are left out.
CrossedMean differenceOfRatings(const CrossedTable& a, const CrossedTable& b, Generalisation generalisation, Degrees degrees,
                                StudentQuantiles& quantiles);

}  // namespace stats
