// Mid-ranks: tied values share the mean of their ranks.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace stats {

struct MidRanks {
    std::vector<long long> doubled;  ///< twice the rank of each value (1 = smallest), hence whole
    std::vector<std::size_t> ties;   ///< sizes of the groups of equal values, 1 for a value alone
};

/// T: a number type with < and ==.
template <typename T>
MidRanks midRanks(std::span<const T> x);

extern template MidRanks midRanks<double>(std::span<const double>);
extern template MidRanks midRanks<long long>(std::span<const long long>);

}  // namespace stats
