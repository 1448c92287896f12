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

/// Mid-ranks of numbers of a type T that has < and ==.
template <typename T>
MidRanks midRanks(std::span<const T> x);

extern template MidRanks midRanks<double>(std::span<const double>);
extern template MidRanks midRanks<long long>(std::span<const long long>);

}  // namespace stats
