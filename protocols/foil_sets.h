// Which sets of foils a participant meets beside each true fabric, not yet in which order.
#pragma once

#include <cstdint>
#include <vector>

#include "protocols/random.h"
#include "protocols/running_orders.h"

namespace protocols {

/// Foils beside one true fabric, ascending.
using FoilSet = std::vector<int>;

/// n over k, or `limit` where it is more.
std::int64_t combinations(std::int64_t n, std::int64_t k, std::int64_t limit);

/// All sets of `count` fabrics other than `trueFabric`, in lexicographic order.
std::vector<FoilSet> allFoilSets(int fabrics, int trueFabric, int count);

/// [participant][true fabric][label]: as many sets as there are labels, different as long as there are
/// enough; over the study each set equally often per true fabric; each foil equally often within
/// participant x true fabric and within participant. `foils` is the number of fabrics in a set.
std::vector<std::vector<std::vector<FoilSet>>> drawFoilSets(const StudySize& size, int foils, Random& random);

}  // namespace protocols
