// P values adjusted for the number of tests in a family.
#pragma once

#include <span>
#include <vector>

#include "stats/kernels/value.h"

namespace stats {

enum class Adjustment {
    Holm,      ///< family-wise error, needs no assumption (Holm 1979)
    Hochberg,  ///< family-wise error, under positive dependence
    Bonferroni,
    BenjaminiHochberg,  ///< false discovery rate
    BenjaminiYekutieli,
};

/// Adjusted values in the order of the raw ones. An undefined p stays undefined and does not count as a member
/// of the family. No adjusted p is below its raw p; in a family of one they are equal.
std::vector<Value> adjusted(std::span<const Value> p, Adjustment method);

}  // namespace stats
