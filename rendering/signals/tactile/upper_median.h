// Median without interpolation.
#pragma once

#include <algorithm>
#include <vector>

namespace rendering::signals {

/// Middle value; of two middle values the larger one. Returns 0 for no values.
inline double upperMedian(std::vector<double> values)
{
    if (values.empty()) return 0;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

}  // namespace rendering::signals
