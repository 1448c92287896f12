// Ratings are decimals: 0.3 - 0.2 and 0.9 - 0.8 are tied, although their doubles differ. Sums, ranks
// and means of such data are taken on whole multiples of 10^-places, where ties are ties.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "stats/kernels/value.h"

namespace stats {

/// Numbers as whole multiples of 10^-places.
struct DecimalGrid {
    int places = 0;
    std::vector<std::int64_t> units;

    double unitsPerOne() const;
};

/// The coarsest grid (0 to 9 places) on which every number lies, each being the double nearest to a
/// multiple; none where there is no such grid or a number is too large (above 10^15 units).
std::optional<DecimalGrid> decimalGridOf(std::span<const double> x);

/// Mean; on a decimal grid exactly rounded, so that equal sums of equally many ratings give equal means
/// in any order. Undefined for no values or values that are not finite.
Value meanOf(std::span<const double> x);

}  // namespace stats
