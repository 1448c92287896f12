// Draws the sets of foils that each participant gets with each true fabric, not yet their order.
#pragma once

#include <cstdint>
#include <vector>

#include "protocols/random.h"

namespace protocols {

/// Foils of one true fabric, ascending.
using FoilSet = std::vector<int>;

/// The binomial coefficient n over k, at most `limit`.
std::int64_t combinations(std::int64_t n, std::int64_t k, std::int64_t limit);

/// All sets of `count` fabrics other than `trueFabric`, in lexicographic order.
std::vector<FoilSet> allFoilSets(int fabrics, int trueFabric, int count);

/// [participant][true fabric][presentation]: one set for each presentation, different as long as there are enough sets. Over the
/// study each set is equally frequent per true fabric. Within participant each fabric lies on the tray equally often, as the true
/// one or as a foil. `timesTrue`: [participant][fabric], the number of presentations. `foils`: number of fabrics in a set.
std::vector<std::vector<std::vector<FoilSet>>> drawFoilSets(const std::vector<std::vector<int>>& timesTrue, int foils,
                                                            Random& random);

}  // namespace protocols
