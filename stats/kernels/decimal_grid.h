// Ratings are decimals: 0.3 - 0.2 and 0.9 - 0.8 are tied, although their doubles differ. Sums, ranks
// and means of such data are therefore computed from whole multiples of 10^-places, where ties are exact.
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

/// The coarsest grid (0 to 9 places) on which every number lies: each is the double nearest to a multiple.
/// Empty where there is no such grid, or where a number exceeds 10^15 units.
std::optional<DecimalGrid> decimalGridOf(std::span<const double> x);

/// Multiples of `unit` next to the numbers; halves go up. On a decimal grid they are exact: 0.15 is a half of 0.1, although
/// its double is below. `unit` > 0 is 1, 2 or 5 times a power of ten; NaN stays NaN.
std::vector<double> roundedHalvesUp(std::span<const double> x, double unit);

/// Mean. On a decimal grid it is exactly rounded: equal sums of equally many ratings give equal means in any
/// order. Undefined for no values and for values that are not finite.
Value meanOf(std::span<const double> x);

}  // namespace stats
