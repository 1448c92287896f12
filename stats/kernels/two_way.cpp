#include "stats/kernels/two_way.h"

#include <algorithm>
#include <cmath>

#include "stats/kernels/exact_sum.h"
#include "stats/kernels/moments.h"

namespace stats {
namespace {

double meanOfSmall(std::span<const double> x) { return momentsOf(x).meanMinus(0); }

double sumOfSquares(std::span<const double> x)
{
    return orderFreeSum(x.size(), [x](std::size_t i) { return x[i] * x[i]; });
}

double largestOf(std::span<const double> x)
{
    double largest = 0;
    for (const double value : x) largest = std::max(largest, std::fabs(value));
    return largest;
}

/// A residual is made of four rounded values, each off by at most a unit in the last place.
constexpr double roundings = 4;

}  // namespace

bool TwoWayEffects::hasNoResiduals() const { return largestOf(residual) <= roundings * grain; }

bool TwoWayEffects::isConstant() const
{
    return hasNoResiduals() && largestOf(block) <= roundings * grain && largestOf(condition) <= roundings * grain;
}

TwoWayEffects twoWayEffects(std::span<const double> scaled, const BlockTable& shape)
{
    const std::size_t n = shape.blocks;
    const std::size_t k = shape.conditions;
    const Moments all = momentsOf(scaled);
    // Differences from a number near the mean are almost exact, and all later sums are small.
    std::vector<double> y(scaled.size());
    std::transform(scaled.begin(), scaled.end(), y.begin(), [&](double x) { return (x - all.shift) - all.residual; });
    TwoWayEffects effects;
    effects.blocks = n;
    effects.conditions = k;
    effects.grain = unitInLastPlace(std::max(std::fabs(all.smallest), std::fabs(all.largest)));
    for (std::size_t i = 0; i < n; ++i) effects.block.push_back(meanOfSmall(std::span(y).subspan(i * k, k)));
    std::vector<double> column(n);
    for (std::size_t j = 0; j < k; ++j) {
        for (std::size_t i = 0; i < n; ++i) column[i] = y[i * k + j] - effects.block[i];
        effects.condition.push_back(meanOfSmall(column));
    }
    effects.residual.resize(y.size());
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < k; ++j) effects.residual[i * k + j] = y[i * k + j] - effects.block[i] - effects.condition[j];
    effects.ssBlock = static_cast<double>(k) * sumOfSquares(effects.block);
    effects.ssCondition = static_cast<double>(n) * sumOfSquares(effects.condition);
    effects.ssResidual = sumOfSquares(effects.residual);
    return effects;
}

std::string twoWayFault(const BlockTable& table)
{
    if (table.conditions < 2) return "needs at least 2 conditions";
    if (table.blocks < 2) return "needs at least 2 complete blocks";
    return nonFiniteFault(table.values, "the table");
}

}  // namespace stats
