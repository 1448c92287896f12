// P values adjusted for how many tests a family holds.
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

/// Adjusted values in the places of the raw ones. An undefined p stays undefined and is not counted as
/// a member of the family. Never below the raw value; equal to it for a family of one.
std::vector<Value> adjusted(std::span<const Value> p, Adjustment method);

}  // namespace stats
