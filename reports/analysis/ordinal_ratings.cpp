#include "reports/analysis/ordinal_ratings.h"

#include <cmath>
#include <utility>

#include "protocols/files/number_text.h"
#include "stats/kernels/decimal_grid.h"

namespace reports {
namespace {

constexpr double fewestWholeSteps = 2;
constexpr double mostWholeSteps = 20;
constexpr double mostSteps = 15;

/// leading * 10^power as the nearest double.
double decimalUnit(double leading, int power)
{
    return power < 0 ? leading / std::pow(10, -power) : leading * std::pow(10, power);
}

}  // namespace

double roundingUnit(const NumberOnScale& scale)
{
    const double span = scale.max - scale.min;
    if (!(span > 0) || !std::isfinite(span) || (span >= fewestWholeSteps && span <= mostWholeSteps)) return 1;
    for (int power = static_cast<int>(std::floor(std::log10(span))) - 2;; ++power)
        for (const double leading : {1.0, 2.0, 5.0})
            // 1 / 0.1 is not 10 in binary, and 15 steps are allowed.
            if (const double unit = decimalUnit(leading, power); span / unit < mostSteps + 0.5) return unit;
}

std::string roundingWords(double unit)
{
    return unit == 1 ? "to whole numbers, halves up" : "to multiples of " + protocols::shortest(unit) + ", halves up";
}

OrdinalRatings ordinalRatings(stats::CrossedStudy ratings, const NumberOnScale& scale, Depth depth)
{
    OrdinalRatings result;
    result.unit = roundingUnit(scale);
    if (depth == Depth::Quick) {
        result.why = "left out by --quick";
        return result;
    }
    ratings.values = stats::roundedHalvesUp(ratings.values, result.unit);
    result.fitted = stats::fitOrdinal(ratings);
    result.why = result.fitted.model.why;
    return result;
}

}  // namespace reports
