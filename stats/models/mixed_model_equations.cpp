#include "stats/models/mixed_model_equations.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "stats/models/mixed_model_criterion.h"

namespace stats {
namespace {

constexpr std::size_t noTerm = static_cast<std::size_t>(-1);

/// The intercept term with the most levels, whose elimination saves the most work.
std::size_t termToEliminate(std::span<const RandomTerm> terms)
{
    std::size_t best = noTerm;
    for (std::size_t t = 0; t < terms.size(); ++t)
        if (terms[t].slope.empty() && (best == noTerm || terms[t].group.levels.size() > terms[best].group.levels.size()))
            best = t;
    return best;
}

/// Row c becomes diagonal[c] row c + below[c] row c+1.
template <typename Scaling>
void scaleRows(Matrix& matrix, const Scaling& scale)
{
    for (std::size_t c = 0; c < scale.diagonal.size(); ++c) {
        const auto row = matrix.row(c);
        for (double& x : row) x *= scale.diagonal[c];
        if (scale.below[c] == 0) continue;
        const auto next = matrix.row(c + 1);
        for (std::size_t j = 0; j < row.size(); ++j) row[j] += scale.below[c] * next[j];
    }
}

template <typename Scaling>
void scaleEntries(std::span<double> entries, const Scaling& scale)
{
    for (std::size_t c = 0; c < scale.diagonal.size(); ++c) {
        entries[c] *= scale.diagonal[c];
        if (scale.below[c] != 0) entries[c] += scale.below[c] * entries[c + 1];
    }
}

template <typename Scaling>
void scaleColumns(Matrix& matrix, const Scaling& scale)
{
    for (std::size_t i = 0; i < matrix.rows(); ++i) scaleEntries(matrix.row(i), scale);
}

}  // namespace

MixedModelEquations::MixedModelEquations(std::span<const double> y, const FixedEffects& fixed, std::span<const RandomTerm> terms)
    : MixedModelSystem(y.size(), fixed.columns.size())
{
    place(terms);
    sumProducts({y, fixed, terms});
}

void MixedModelEquations::place(std::span<const RandomTerm> terms)
{
    const std::size_t first = termToEliminate(terms);
    m_eliminated = first == noTerm ? 0 : terms[first].group.levels.size();
    std::size_t column = m_eliminated;
    std::size_t theta = 0;
    for (std::size_t t = 0; t < terms.size(); ++t) {
        TermPlace where{terms[t].slope.empty() ? 1U : 2U, terms[t].group.levels.size(), t == first ? 0 : column, theta};
        if (t != first) column += where.components * where.levels;
        theta += where.components == 1 ? 1 : 3;
        m_terms.push_back(where);
    }
    m_rest = column - m_eliminated;
}

/// Collects the nonzeros of a row outside the eliminated block. Returns its level there, or noTerm.
std::size_t MixedModelEquations::nonzerosOf(std::size_t i, const Columns& data, std::vector<Nonzero>& row) const
{
    row.clear();
    std::size_t level = noTerm;
    for (std::size_t t = 0; t < data.terms.size(); ++t) {
        const RandomTerm& term = data.terms[t];
        const std::size_t column = m_terms[t].firstColumn + m_terms[t].components * term.group.of[i];
        if (column < m_eliminated) {
            level = column;
            continue;
        }
        row.push_back({column - m_eliminated, 1});
        if (m_terms[t].components == 2) row.push_back({column - m_eliminated + 1, term.slope[i]});
    }
    for (std::size_t j = 0; j < m_fixed; ++j)
        if (data.fixed.columns[j][i] != 0) row.push_back({m_rest + j, data.fixed.columns[j][i]});
    row.push_back({m_rest + m_fixed, data.y[i]});
    return level;
}

void MixedModelEquations::sumProducts(const Columns& data)
{
    const std::size_t size = m_rest + m_fixed + 1;
    m_products = Matrix(size, size);
    m_counts.assign(m_eliminated, 0);
    Matrix borders(m_eliminated, size);
    std::vector<std::vector<bool>> touched(m_eliminated, std::vector<bool>(size));
    std::vector<Nonzero> row;
    for (std::size_t i = 0; i < m_rows; ++i) {
        const std::size_t level = nonzerosOf(i, data, row);
        for (const Nonzero& a : row)
            for (const Nonzero& b : row)
                if (a.column <= b.column) m_products(a.column, b.column) += a.value * b.value;
        if (level == noTerm) continue;
        m_counts[level] += 1;
        for (const Nonzero& a : row) {
            borders(level, a.column) += a.value;
            touched[level][a.column] = true;
        }
    }
    for (std::size_t level = 0; level < m_eliminated; ++level) {
        for (std::size_t c = 0; c < size; ++c)
            if (touched[level][c]) {
                m_borders.columns.push_back(static_cast<std::uint32_t>(c));
                m_borders.values.push_back(borders(level, c));
            }
        m_borders.starts.push_back(m_borders.columns.size());
    }
}

/// Scaling of all random columns.
MixedModelEquations::Scaling MixedModelEquations::scaling(std::span<const double> theta) const
{
    Scaling scale{std::vector<double>(m_eliminated + m_rest, 1), std::vector<double>(m_eliminated + m_rest, 0)};
    for (const TermPlace& term : m_terms)
        for (std::size_t level = 0; level < term.levels; ++level) {
            const std::size_t c = term.firstColumn + level * term.components;
            scale.diagonal[c] = theta[term.firstTheta];
            if (term.components == 1) continue;
            scale.below[c] = theta[term.firstTheta + 1];
            scale.diagonal[c + 1] = theta[term.firstTheta + 2];
        }
    return scale;
}

MixedModelEquations::Scaling MixedModelEquations::inverseScaling(std::span<const double> theta) const
{
    Scaling scale = scaling(theta);
    for (std::size_t c = 0; c < scale.diagonal.size(); ++c) {
        const double below = scale.below[c];
        if (below != 0) scale.below[c] = -below / (scale.diagonal[c] * scale.diagonal[c + 1]);
        scale.diagonal[c] = 1 / scale.diagonal[c];
    }
    return scale;
}

/// Scales the borders of one level.
void MixedModelEquations::scaleBorder(std::span<double> values, std::size_t level, const Scaling& scale) const
{
    for (std::size_t k = 0; k < values.size(); ++k) {
        const std::size_t c = m_borders.columns[m_borders.starts[level] + k];
        if (c >= m_rest) continue;
        values[k] *= scale.diagonal[m_eliminated + c];
        const double below = scale.below[m_eliminated + c];
        if (below != 0) values[k] += below * values[k + 1];  // intercept and slope of a level are neighbours
    }
    for (double& value : values) value *= scale.diagonal[level];
}

/// Scales the eliminated rows and subtracts their products from the rest, which becomes the Schur complement.
void MixedModelEquations::eliminate(Factorised& result, const Scaling& scale) const
{
    result.pivots.resize(m_eliminated);
    result.bordering = m_borders.values;
    for (std::size_t level = 0; level < m_eliminated; ++level) {
        const double own = scale.diagonal[level];
        const double pivot = result.pivots[level] = own * own * m_counts[level] + 1;
        result.logDetRandom += std::log(pivot);
        const std::size_t from = m_borders.starts[level];
        const std::size_t size = m_borders.starts[level + 1] - from;
        const auto values = std::span(result.bordering).subspan(from, size);
        scaleBorder(values, level, scale);
        const std::uint32_t* const columns = m_borders.columns.data() + from;
        for (std::size_t k = 0; k < size; ++k) {
            const double factor = values[k] / pivot;
            const auto row = result.upper.row(columns[k]);
            for (std::size_t l = k; l < size; ++l) row[columns[l]] -= factor * values[l];
        }
    }
}

Factorised MixedModelEquations::factorised(std::span<const double> theta) const
{
    Factorised result;
    result.theta.assign(theta.begin(), theta.end());
    const Scaling all = scaling(theta);
    const auto restOf = [&](const std::vector<double>& x) {
        return std::vector<double>(x.begin() + static_cast<std::ptrdiff_t>(m_eliminated), x.end());
    };
    const Scaling rest{restOf(all.diagonal), restOf(all.below)};
    result.upper = m_products;
    for (std::size_t i = 0; i < m_rest; ++i)
        if (rest.below[i] != 0) result.upper(i + 1, i) = result.upper(i, i + 1);  // scaleRows reads it
    scaleRows(result.upper, rest);
    scaleColumns(result.upper, rest);
    for (std::size_t i = 0; i < m_rest; ++i) result.upper(i, i) += 1;
    eliminate(result, all);
    const std::size_t size = result.upper.rows();
    if (factorise(result.upper) < size) return result;
    for (std::size_t i = 0; i + 1 < size; ++i)
        (i < m_rest ? result.logDetRandom : result.logDetFixed) += 2 * std::log(result.upper(i, i));
    result.residual = result.upper(size - 1, size - 1) * result.upper(size - 1, size - 1);
    result.exists = std::isfinite(result.residual);
    return result;
}

/// Scaled borders times the inverse of the rest: [eliminated x order of the inverse].
Matrix MixedModelEquations::bordered(const Factorised& factorised, const Matrix& inverse) const
{
    Matrix result(m_eliminated, inverse.columns());
    for (std::size_t level = 0; level < m_eliminated; ++level)
        for (std::size_t k = m_borders.starts[level]; k < m_borders.starts[level + 1]; ++k) {
            if (m_borders.columns[k] >= inverse.columns()) continue;
            const auto row = result.row(level);
            const auto source = inverse.row(m_borders.columns[k]);
            for (std::size_t j = 0; j < row.size(); ++j) row[j] += factorised.bordering[k] * source[j];
        }
    return result;
}

/// Z'PZ, or Z'V^-1 Z where `inverse` leaves out the fixed effects: Lambda^-T (I - K) Lambda^-1, where K is the random
/// part of the inverse of the whole system.
Matrix MixedModelEquations::whitened(const Factorised& factorised, const Matrix& inverse, const Matrix& bordering) const
{
    Matrix result(m_eliminated + m_rest, m_eliminated + m_rest);
    const auto& d = factorised.pivots;
    for (std::size_t a = 0; a < m_eliminated; ++a) {
        for (std::size_t b = 0; b <= a; ++b) {
            double sum = 0;
            for (std::size_t k = m_borders.starts[b]; k < m_borders.starts[b + 1]; ++k)
                if (m_borders.columns[k] < inverse.columns()) sum += factorised.bordering[k] * bordering(a, m_borders.columns[k]);
            result(a, b) = result(b, a) = (a == b ? 1 - 1 / d[a] : 0) - sum / (d[a] * d[b]);
        }
        for (std::size_t j = 0; j < m_rest; ++j)
            result(m_eliminated + j, a) = result(a, m_eliminated + j) = bordering(a, j) / d[a];
    }
    for (std::size_t i = 0; i < m_rest; ++i)
        for (std::size_t j = 0; j < m_rest; ++j) result(m_eliminated + i, m_eliminated + j) = (i == j ? 1 : 0) - inverse(i, j);
    const Scaling scale = inverseScaling(factorised.theta);
    scaleRows(result, scale);
    scaleColumns(result, scale);
    return result;
}

Solved MixedModelEquations::solved(const Factorised& factorised, bool withWeighted) const
{
    const std::size_t order = m_rest + m_fixed;
    const Matrix lowerInverse = inverseOfTransposed(factorised.upper, order);
    const Matrix inverse = inverseFrom(lowerInverse, order);
    const Matrix bordering = bordered(factorised, inverse);
    Solved result;
    result.projected = whitened(factorised, inverse, bordering);
    if (withWeighted) {
        const Matrix random = inverseFrom(lowerInverse, m_rest);
        result.weighted = whitened(factorised, random, bordered(factorised, random));
    }

    std::vector<double> solution(order);
    for (std::size_t k = 0; k < order; ++k)
        for (std::size_t i = 0; i <= k; ++i) solution[i] += lowerInverse(k, i) * factorised.upper(k, order);
    const Scaling scale = inverseScaling(factorised.theta);
    result.score = scoreOf(factorised, solution);
    scaleEntries(result.score, scale);
    result.fixed.assign(solution.begin() + static_cast<std::ptrdiff_t>(m_rest), solution.end());
    putFixedParts(result, factorised, inverse, bordering);
    scaleColumns(result.fixedOnRandom, scale);
    return result;
}

SystemSolution MixedModelEquations::solutionAt(std::span<const double> theta, bool reml) const
{
    Solved all = solved(factorised(theta), !reml);
    VarianceDerivatives derivatives = varianceDerivatives(*this, all, reml);
    return {std::move(all.fixed), std::move(all.fixedCovariance), std::move(derivatives)};
}

/// The random effects u = Lambda'Z'Py: the eliminated ones, then the others.
std::vector<double> MixedModelEquations::scoreOf(const Factorised& factorised, std::span<const double> solution) const
{
    std::vector<double> score;
    for (std::size_t level = 0; level < m_eliminated; ++level) {
        double sum = 0;
        for (std::size_t k = m_borders.starts[level]; k < m_borders.starts[level + 1]; ++k) {
            const std::size_t c = m_borders.columns[k];
            sum += factorised.bordering[k] * (c < solution.size() ? -solution[c] : 1);  // the last column is y
        }
        score.push_back(sum / factorised.pivots[level]);
    }
    score.insert(score.end(), solution.begin(), solution.begin() + static_cast<std::ptrdiff_t>(m_rest));
    return score;
}

/// C, and C X'V^-1 Z Lambda, from the inverse of the whole system.
void MixedModelEquations::putFixedParts(Solved& result, const Factorised& factorised, const Matrix& inverse,
                                        const Matrix& bordering) const
{
    result.fixedCovariance = Matrix(m_fixed, m_fixed);
    result.fixedOnRandom = Matrix(m_fixed, m_eliminated + m_rest);
    for (std::size_t i = 0; i < m_fixed; ++i) {
        for (std::size_t j = 0; j < m_fixed; ++j) result.fixedCovariance(i, j) = inverse(m_rest + i, m_rest + j);
        for (std::size_t a = 0; a < m_eliminated; ++a)
            result.fixedOnRandom(i, a) = bordering(a, m_rest + i) / factorised.pivots[a];
        for (std::size_t j = 0; j < m_rest; ++j) result.fixedOnRandom(i, m_eliminated + j) = -inverse(m_rest + i, j);
    }
}

}  // namespace stats
