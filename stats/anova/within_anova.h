// Two-way analyses of variance with repeated measures: both factors within participants, or one between and one within.
#pragma once

#include <span>

#include "stats/anova/two_way_anova.h"
#include "stats/models/factor.h"

namespace stats {

/// Both factors within participants. Repetitions of a cell are averaged, NaN is missing, and a participant with an empty
/// cell is dropped and counted. Each effect has its own interaction with participant as its error. Refused with a reason:
/// fewer than 2 levels or 2 complete participants, a value that is not finite.
TwoWayAnova twoWayWithin(std::span<const double> values, const Factor& participant, const Factor& a, const Factor& b);

/// Split-plot design: groups of participants (first factor) by conditions within participants (second factor). Refused
/// also: a participant in two groups, as many groups as participants.
TwoWayAnova twoWayMixed(std::span<const double> values, const Factor& participant, const Factor& between, const Factor& within,
                        SumsOfSquares type);

}  // namespace stats
