#include "stats/claims/within_trend.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "stats/kernels/matrix.h"

namespace stats {
namespace {

/// A column that keeps less than this share of its squares depends on the others.
constexpr double leastShare = 1e-9;
/// Effects of condition and fabric that add up exactly leave rounding errors of this size, which are no slope.
constexpr double rounding = 1e-13;

std::vector<TrendRow> sorted(std::span<const TrendRow> rows)
{
    std::vector<TrendRow> ordered(rows.begin(), rows.end());
    std::sort(ordered.begin(), ordered.end(), [](const TrendRow& a, const TrendRow& b) {
        return std::tie(a.condition, a.fabric, a.covariate, a.value) < std::tie(b.condition, b.fabric, b.covariate, b.value);
    });
    return ordered;
}

/// Removes the means of the conditions; the rows are sorted by condition.
void centreWithinConditions(std::span<const TrendRow> rows, std::vector<double>& column)
{
    for (std::size_t begin = 0; begin < rows.size();) {
        std::size_t end = begin;
        // Differences from the first value: a column that is constant within a condition becomes exactly 0.
        const double first = column[begin];
        double sum = 0;
        for (; end < rows.size() && rows[end].condition == rows[begin].condition; ++end) sum += column[end] - first;
        const double mean = first + sum / static_cast<double>(end - begin);
        for (; begin < end; ++begin) column[begin] -= mean;
    }
}

void removeFrom(std::vector<double>& column, const std::vector<double>& direction)
{
    const double factor = dot(column, direction) / dot(direction, direction);
    for (std::size_t i = 0; i < column.size(); ++i) column[i] -= factor * direction[i];
}

/// Columns that code the fabrics within the conditions, orthogonal to each other.
std::vector<std::vector<double>> fabricDirections(std::span<const TrendRow> rows)
{
    std::set<std::size_t> fabrics;
    for (const TrendRow& row : rows) fabrics.insert(row.fabric);
    std::vector<std::vector<double>> directions;
    for (const std::size_t fabric : fabrics) {
        std::vector<double> column;
        for (const TrendRow& row : rows) column.push_back(row.fabric == fabric ? 1 : 0);
        const double whole = dot(column, column);
        centreWithinConditions(rows, column);
        for (const std::vector<double>& direction : directions) removeFrom(column, direction);
        if (dot(column, column) > leastShare * whole) directions.push_back(std::move(column));
    }
    return directions;
}

double sumOfSquares(std::span<const double> column)
{
    double sum = 0, squares = 0;
    for (const double x : column) sum += x;
    const double mean = sum / static_cast<double>(column.size());
    for (const double x : column) squares += (x - mean) * (x - mean);
    return squares;
}

}  // namespace

Value adjustedSlope(std::span<const TrendRow> unsorted)
{
    const std::vector<TrendRow> rows = sorted(unsorted);
    std::set<std::size_t> conditions;
    std::vector<double> x, y;
    for (const TrendRow& row : rows) {
        if (!std::isfinite(row.covariate) || !std::isfinite(row.value)) return Value::undefined("a value is not finite");
        conditions.insert(row.condition);
        x.push_back(row.covariate);
        y.push_back(row.value);
    }
    const std::vector<std::vector<double>> directions = fabricDirections(rows);
    if (rows.size() < conditions.size() + directions.size() + 1 + fewestFreeAnswers)
        return Value::undefined("too few answers for a slope beside the other effects");
    const double whole = sumOfSquares(x);
    centreWithinConditions(rows, x);
    for (const std::vector<double>& direction : directions) removeFrom(x, direction);
    const double left = dot(x, x);
    if (!(left > leastShare * whole)) return Value::undefined("it does not vary beside the other effects");
    const double size = std::sqrt(dot(y, y));
    // The mean may be large beside the differences, and x is orthogonal to it only up to rounding.
    centreWithinConditions(rows, y);
    const double product = dot(x, y);
    return std::fabs(product) > rounding * std::sqrt(left) * size ? product / left : 0.0;
}

TTest noTest(const std::string& why)
{
    TTest none;
    none.why = why;
    for (Value* value : {&none.estimate, &none.sd, &none.se, &none.t, &none.df, &none.p, &none.logP, &none.ci.low, &none.ci.high})
        *value = Value::undefined(why);
    return none;
}

WithinTrend withinTrend(std::span<const std::vector<TrendRow>> participants)
{
    WithinTrend trend;
    std::vector<double> slopes;
    std::string why;
    for (const std::vector<TrendRow>& rows : participants) {
        trend.slopes.push_back(adjustedSlope(rows));
        if (trend.slopes.back().exists())
            slopes.push_back(*trend.slopes.back());
        else
            why = trend.slopes.back().why();
    }
    trend.test = oneSampleTTest(slopes);
    // The reason why nobody has a slope says more than that there are no values.
    if (slopes.empty() && !why.empty()) trend.test = noTest(why);
    return trend;
}

}  // namespace stats
