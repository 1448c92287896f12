// Draws the sets of foils that each participant gets with each true fabric, not yet their order.
#pragma once

#include <cstdint>
#include <vector>

#include "protocols/random.h"
#include "protocols/running_orders.h"

namespace protocols {

/// Foils of one true fabric, ascending.
using FoilSet = std::vector<int>;

/// The binomial coefficient n over k, at most `limit`.
std::int64_t combinations(std::int64_t n, std::int64_t k, std::int64_t limit);

/// All sets of `count` fabrics other than `trueFabric`, in lexicographic order.
std::vector<FoilSet> allFoilSets(int fabrics, int trueFabric, int count);

/// [participant][true fabric][label]: one set for each label, different as long as there are enough sets. Over the study each
/// set is equally frequent per true fabric; each foil is equally frequent within participant. `foils`: number of fabrics in a
/// set.
std::vector<std::vector<std::vector<FoilSet>>> drawFoilSets(const StudySize& size, int foils, Random& random);

}  // namespace protocols
