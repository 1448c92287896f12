#include "stats/kernels/decimal_grid.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "stats/kernels/moments.h"

namespace stats {
namespace {

constexpr std::array<double, 10> powersOfTen{1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9};
constexpr double mostUnits = 1e15;

bool liesOn(double x, double unitsPerOne)
{
    const double units = std::nearbyint(x * unitsPerOne);
    // Both numbers are whole and below 2^53, so that the division gives the nearest double.
    return std::fabs(units) <= mostUnits && units / unitsPerOne == x;
}

}  // namespace

double DecimalGrid::unitsPerOne() const { return powersOfTen[static_cast<std::size_t>(places)]; }

std::optional<DecimalGrid> decimalGridOf(std::span<const double> x)
{
    int places = 0;
    for (const double value : x)
        while (!liesOn(value, powersOfTen[static_cast<std::size_t>(places)]))
            if (++places == static_cast<int>(powersOfTen.size())) return std::nullopt;
    DecimalGrid grid;
    grid.places = places;
    grid.units.reserve(x.size());
    for (const double value : x) {
        // The common grid may be finer than the value's own, and then too fine for a large value.
        if (!liesOn(value, grid.unitsPerOne())) return std::nullopt;
        grid.units.push_back(static_cast<std::int64_t>(std::nearbyint(value * grid.unitsPerOne())));
    }
    return grid;
}

std::vector<double> roundedHalvesUp(std::span<const double> x, double unit)
{
    std::vector<double> rounded;
    for (const double value : x) {
        const auto grid = decimalGridOf(std::array{value, unit});
        if (!std::isfinite(value) || !grid) {
            rounded.push_back(std::floor(value / unit + 0.5) * unit);
            continue;
        }
        const std::int64_t half = 2 * grid->units[0] + grid->units[1], whole = 2 * grid->units[1];
        const std::int64_t multiple = half / whole - (half % whole < 0 ? 1 : 0);
        rounded.push_back(static_cast<double>(multiple * grid->units[1]) / grid->unitsPerOne());
    }
    return rounded;
}

Value meanOf(std::span<const double> x)
{
    if (x.empty()) return Value::undefined("there are no values");
    if (const std::string fault = nonFiniteFault(x, "the sample"); !fault.empty()) return Value::undefined(fault);
    if (const auto grid = decimalGridOf(x); grid && x.size() < 1000) {
        std::int64_t sum = 0;
        for (const std::int64_t units : grid->units) sum += units;
        const double divisor = grid->unitsPerOne() * static_cast<double>(x.size());
        if (std::fabs(static_cast<double>(sum)) < 9e15) return static_cast<double>(sum) / divisor;
    }
    const ScaledSamples scaled({x});
    return scaled.unscaled(momentsOf(scaled.sample(0)).mean());
}

}  // namespace stats
