// Two-way analysis of variance of independent values: both factors lie between the values.
#pragma once

#include <span>

#include "stats/anova/two_way_anova.h"
#include "stats/models/factor.h"

namespace stats {

/// The most levels of the factor that has fewer: the time grows with its cube.
inline constexpr std::size_t mostAdditiveLevels = 1000;

/// Analysis with interaction; NaN is missing. Refused with a reason: a factor of one level, one value in each cell, no
/// variation within any cell. Refused as well: cells that do not connect all levels, and for type III an empty cell.
///
/// Type II: additive model of both factors by weighted least squares on the cell means. Type III: weighted squares of means
/// (Yates 1934).
TwoWayAnova twoWayBetween(std::span<const double> values, const Factor& a, const Factor& b, SumsOfSquares type);

}  // namespace stats
