#include "stats/kernels/ranks.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "stats/kernels/decimal_grid.h"
#include "stats/kernels/moments.h"

namespace stats {

std::vector<double> withoutRounding(std::span<const double> x, double size)
{
    std::vector<double> rounded(x.begin(), x.end());
    const auto isWhole = [](double value) { return value == std::trunc(value); };
    if (decimalGridOf(x) || std::all_of(x.begin(), x.end(), isWhole)) return rounded;
    std::vector<std::size_t> order(x.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [x](std::size_t a, std::size_t b) { return x[a] < x[b]; });
    for (std::size_t i = 1; i < order.size(); ++i) {
        double& value = rounded[order[i]];
        const double before = rounded[order[i - 1]];
        const double largest = std::max({size, std::fabs(value), std::fabs(before)});
        if (value - before <= computedNoise * unitInLastPlace(largest)) value = before;
    }
    return rounded;
}

template <typename T>
MidRanks midRanks(std::span<const T> x)
{
    std::vector<std::size_t> order(x.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [x](std::size_t a, std::size_t b) { return x[a] < x[b]; });
    MidRanks ranks;
    ranks.doubled.resize(x.size());
    for (std::size_t begin = 0; begin < order.size();) {
        std::size_t end = begin + 1;
        while (end < order.size() && x[order[end]] == x[order[begin]]) ++end;
        for (std::size_t i = begin; i < end; ++i) ranks.doubled[order[i]] = static_cast<long long>(begin + 1 + end);
        ranks.ties.push_back(end - begin);
        begin = end;
    }
    return ranks;
}

template MidRanks midRanks<double>(std::span<const double>);
template MidRanks midRanks<long long>(std::span<const long long>);

}  // namespace stats
