// Mid-ranks: tied values share the mean of their ranks.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace stats {

struct MidRanks {
    std::vector<long long> doubled;  ///< twice the rank of each value (1 = smallest), which is a whole number
    std::vector<std::size_t> ties;   ///< sizes of the groups of equal values; 1 for a single value
};

/// The numbers, with those made equal that differ by rounding alone: by at most computedNoise units in the last place of the
/// larger one, or of `size` where that is larger. The mean 37/6 differs in its last bit where other sums lead to it. Whole
/// numbers and numbers on a decimal grid are exact and stay as they are.
std::vector<double> withoutRounding(std::span<const double> x, double size = 0);

/// Mid-ranks of numbers of a type T that has < and ==.
template <typename T>
MidRanks midRanks(std::span<const T> x);

extern template MidRanks midRanks<double>(std::span<const double>);
extern template MidRanks midRanks<long long>(std::span<const long long>);

}  // namespace stats
