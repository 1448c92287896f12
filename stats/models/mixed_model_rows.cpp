#include "stats/models/mixed_model_rows.h"

#include <algorithm>
#include <cmath>

namespace stats {
namespace {

int exponentOf(std::span<const double> x)
{
    double largest = 0;
    for (const double value : x) largest = std::max(largest, std::fabs(value));
    return largest > 0 ? std::ilogb(largest) : 0;
}

void scale(std::vector<double>& x, int exponent)
{
    for (double& value : x) value = std::ldexp(value, -exponent);
}

std::vector<double> rowsOf(std::span<const double> column, std::span<const std::size_t> rows)
{
    std::vector<double> result;
    for (const std::size_t row : rows) result.push_back(column[row]);
    return result;
}

std::string groupFault(const Factor& group, std::size_t rows)
{
    if (group.levels.size() < 2) return "all values belong to one " + group.name + ": its variance cannot be estimated";
    if (group.levels.size() >= rows)
        return "every value has its own level of " + group.name + ", which cannot be separated from the residual";
    return {};
}

/// Row k: the sequential (type I) contrast of fixed effect k, from the Cholesky factor of X'X.
Matrix sequentialContrasts(const Matrix& upper)
{
    const std::size_t p = upper.rows();
    Matrix contrasts(p, p);
    for (std::size_t k = 0; k < p; ++k)
        for (std::size_t j = k; j < p; ++j) contrasts(k, j) = upper(k, j) / upper(k, k);
    return contrasts;
}

std::string groupsFault(const std::vector<RandomTerm>& terms, std::size_t rows)
{
    for (std::size_t i = 0; i < terms.size(); ++i) {
        if (const std::string fault = groupFault(terms[i].group, rows); !fault.empty()) return fault;
        for (std::size_t j = 0; j < i; ++j)
            if (divideAlike(terms[j].group, terms[i].group))
                return terms[j].group.name + " and " + terms[i].group.name +
                       " divide the values in the same way and cannot be separated";
    }
    return {};
}

/// Subtracts the least-squares fit from y, in two passes: the second recovers the digits that the first lost to a
/// large common offset. Returns the reason where the columns are linearly dependent.
std::string removeFixed(MixedModelRows& data)
{
    const std::size_t p = data.fixed.columns.size();
    std::vector<std::vector<std::size_t>> present(p);  // rows of each column that are not zero: few where conditions are many
    for (std::size_t i = 0; i < p; ++i)
        for (std::size_t row = 0; row < data.y.size(); ++row)
            if (data.fixed.columns[i][row] != 0) present[i].push_back(row);
    const auto productWith = [&](std::size_t i, const std::vector<double>& other) {
        double sum = 0;
        for (const std::size_t row : present[i]) sum += data.fixed.columns[i][row] * other[row];
        return sum;
    };
    Matrix products(p, p);
    for (std::size_t i = 0; i < p; ++i)
        for (std::size_t j = i; j < p; ++j) products(i, j) = products(j, i) = productWith(j, data.fixed.columns[i]);
    Matrix upper = products;
    if (const std::size_t done = factorise(upper); done < p)
        return "the fixed effect " + data.fixed.names[done] + " is determined by those before it, or has no values";
    data.sequential = sequentialContrasts(upper);
    data.leastSquares.assign(p, 0);
    for (int pass = 0; pass < 2; ++pass) {
        std::vector<double> right(p);
        for (std::size_t i = 0; i < p; ++i) right[i] = productWith(i, data.y);
        const auto more = solved(products, right);
        for (std::size_t i = 0; i < p; ++i) {
            data.leastSquares[i] += more[i];
            for (const std::size_t row : present[i]) data.y[row] -= more[i] * data.fixed.columns[i][row];
        }
    }
    return isRoundingError(data.y) ? noVariation : "";
}

bool allFinite(std::span<const double> x)
{
    return std::all_of(x.begin(), x.end(), [](double value) { return std::isfinite(value); });
}

}  // namespace

bool isRoundingError(std::span<const double> y) { return !(dot(y, y) > 1e-24 * static_cast<double>(y.size())); }

MixedModelRows mixedModelRows(const MixedModelData& data)
{
    MixedModelRows result;
    std::vector<std::size_t> rows;
    for (std::size_t row = 0; row < data.y.size(); ++row) std::isnan(data.y[row]) ? void(++result.missing) : rows.push_back(row);
    result.y = rowsOf(data.y, rows);
    result.fixed.names = data.fixed.names;
    for (const auto& column : data.fixed.columns) result.fixed.columns.push_back(rowsOf(column, rows));
    for (const RandomTerm& term : data.random) {
        result.random.push_back({rowsOf(term.group, rows), {}, term.slopeName});
        if (!term.slope.empty()) result.random.back().slope = rowsOf(term.slope, rows);
    }
    if (rows.size() <= data.fixed.columns.size()) {
        result.why = "needs more values than fixed effects; there are " + std::to_string(rows.size());
        return result;
    }
    bool finite = allFinite(result.y);
    for (const auto& column : result.fixed.columns) finite = finite && allFinite(column);
    for (RandomTerm& term : result.random) {
        finite = finite && allFinite(term.slope);
        result.slopeExponents.push_back(exponentOf(term.slope));
        scale(term.slope, result.slopeExponents.back());
    }
    result.why = finite ? groupsFault(result.random, rows.size()) : "a value is not finite";
    if (!result.why.empty()) return result;
    result.exponent = exponentOf(result.y);
    scale(result.y, result.exponent);
    result.why = removeFixed(result);
    return result;
}

bool divideAlike(const Factor& a, const Factor& b)
{
    if (a.levels.size() != b.levels.size()) return false;
    return interactionOf(a, b).levels.size() == a.levels.size();
}

bool hasLevelOfEqualValues(const MixedModelData& data)
{
    const auto levels = codedLevels(data.fixed);
    const std::size_t count = data.fixed.columns.size();
    if (!levels || count < 2) return false;
    std::vector<double> least(count, HUGE_VAL), most(count, -HUGE_VAL);
    for (std::size_t row = 0; row < data.y.size(); ++row) {
        if (std::isnan(data.y[row])) continue;
        const std::size_t level = (*levels)[row];
        least[level] = std::min(least[level], data.y[row]);
        most[level] = std::max(most[level], data.y[row]);
    }
    for (std::size_t level = 0; level < count; ++level)  // means of equal repetitions may differ in the last digit
        if (least[level] <= most[level] &&
            most[level] - least[level] <= 1e-14 * std::max(std::fabs(least[level]), std::fabs(most[level])))
            return true;
    return false;
}

std::optional<std::vector<std::size_t>> codedLevels(const FixedEffects& fixed)
{
    if (fixed.columns.empty()) return {};
    for (const double value : fixed.columns.front())
        if (value != 1) return {};
    std::vector<std::size_t> levels(fixed.columns.front().size());
    for (std::size_t level = 1; level < fixed.columns.size(); ++level)
        for (std::size_t row = 0; row < levels.size(); ++row) {
            const double value = fixed.columns[level][row];
            if (value != 0 && (value != 1 || levels[row] != 0)) return {};
            if (value == 1) levels[row] = level;
        }
    return levels;
}

}  // namespace stats
