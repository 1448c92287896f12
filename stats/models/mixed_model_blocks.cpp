#include "stats/models/mixed_model_blocks.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "stats/kernels/vector_clones.h"

namespace stats {
namespace {

constexpr std::size_t nowhere = static_cast<std::size_t>(-1);

/// Adds the cross-products of the columns of some rows to the upper triangle of `target` [width x width].
STATS_VECTOR_CLONES void addProducts(double* target, const double* rows, std::size_t count, std::size_t width)
{
    for (std::size_t i = 0; i < count; ++i) {
        const double* const row = rows + i * width;
        for (std::size_t a = 0; a < width; ++a) {
            const double factor = row[a];
            double* const out = target + a * width;
            for (std::size_t b = a; b < width; ++b) out[b] += factor * row[b];
        }
    }
}

/// target += a b, row-major [n x m] [m x width].
STATS_VECTOR_CLONES void addProduct(double* target, const double* a, const double* b, std::size_t n, std::size_t m,
                                    std::size_t width)
{
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t k = 0; k < m; ++k) {
            const double factor = a[i * m + k];
            if (factor == 0) continue;
            const double* const row = b + k * width;
            double* const out = target + i * width;
            for (std::size_t j = 0; j < width; ++j) out[j] += factor * row[j];
        }
}

Matrix multiplied(const Matrix& a, const Matrix& b)
{
    Matrix result(a.rows(), b.columns());
    if (a.rows() > 0) addProduct(result.row(0).data(), a.row(0).data(), b.row(0).data(), a.rows(), a.columns(), b.columns());
    return result;
}

Matrix transposed(const Matrix& matrix)
{
    Matrix result(matrix.columns(), matrix.rows());
    for (std::size_t i = 0; i < matrix.rows(); ++i)
        for (std::size_t j = 0; j < matrix.columns(); ++j) result(j, i) = matrix(i, j);
    return result;
}

/// The leading part of an inverse; the other rows and columns are zero.
Matrix leading(const Matrix& part, std::size_t order)
{
    Matrix result(order, order);
    for (std::size_t i = 0; i < part.rows(); ++i) std::ranges::copy(part.row(i), result.row(i).begin());
    return result;
}

}  // namespace

/// The equations at one theta.
struct BlockEquations::Parts {
    CriterionParts criterion;
    std::vector<SolvedBlock> blocks;
    Matrix upper;  ///< Cholesky factor of the border after the elimination of the blocks
};

/// Sums over the blocks; G: the couplings of SolvedBlock, S: a matrix of the order of the border.
struct BlockEquations::TraceSums {
    std::vector<Matrix> squares;      ///< for each nested term k: sum of G_k'G_k
    std::vector<double> traces;       ///< sum of the traces of I - D_kk^-1
    Matrix own;                       ///< sum of |I - D_kl^-1|^2 - 2 <I - D_kl^-1, G_k S G_l'>
    std::vector<Matrix> transformed;  ///< S times the squares
};

BlockEquations::BlockEquations(std::span<const double> y, const FixedEffects& fixed, std::span<const RandomTerm> terms,
                               const RowBlocks& blocks)
    : MixedModelSystem(y.size(), fixed.columns.size()), m_blocks(blocks.count)
{
    for (std::size_t t = 0; t < terms.size(); ++t) {
        const std::size_t levels = terms[t].group.levels.size();
        m_terms.push_back({1, levels, blocks.nested[t] ? 0 : m_acrossColumns, t});
        (blocks.nested[t] ? m_nested : m_across).push_back(t);
        if (!blocks.nested[t]) m_acrossColumns += levels;
    }
    addRows(y, fixed, terms, blocks);
}

void BlockEquations::addRows(std::span<const double> y, const FixedEffects& fixed, std::span<const RandomTerm> terms,
                             const RowBlocks& blocks)
{
    const FixedRows fixedOf = fixedRows(fixed);
    const std::size_t size = m_acrossColumns + m_fixed + 1;
    m_border = Matrix(size, size);
    std::vector<std::vector<std::size_t>> localOf;  // of each level of a nested term
    for (const std::size_t t : m_nested) localOf.emplace_back(terms[t].group.levels.size(), nowhere);
    std::vector<std::pair<std::size_t, double>> entries;
    const auto collect = [&](std::size_t row) {
        entries.clear();
        for (const std::size_t t : m_across) entries.emplace_back(m_terms[t].firstColumn + terms[t].group.of[row], 1);
        for (std::size_t k = fixedOf.starts[row]; k < fixedOf.starts[row + 1]; ++k)
            entries.emplace_back(m_acrossColumns + fixedOf.columns[k], fixedOf.values[k]);
        entries.emplace_back(size - 1, y[row]);
    };
    const auto rows = rowsByBlock(blocks);
    std::vector<std::size_t> place(size, nowhere);
    for (std::size_t b = 0; b < blocks.count; ++b) {
        Block& block = m_blocks[b];
        block.starts.push_back(0);
        for (std::size_t n = 0; n < m_nested.size(); ++n) {
            std::size_t next = block.starts.back();
            for (const std::size_t row : rows[b])
                if (std::size_t& local = localOf[n][terms[m_nested[n]].group.of[row]]; local == nowhere) local = next++;
            block.starts.push_back(next);
        }
        for (const std::size_t row : rows[b]) {
            collect(row);
            for (const auto& [column, value] : entries) {
                if (place[column] == nowhere) block.border.push_back(static_cast<std::uint32_t>(column));
                place[column] = 0;
            }
        }
        std::sort(block.border.begin(), block.border.end());
        for (std::size_t k = 0; k < block.border.size(); ++k) place[block.border[k]] = k;
        const std::size_t own = block.starts.back();
        block.products = Matrix(own, own);
        block.coupling = Matrix(own, block.border.size());
        for (const std::size_t row : rows[b]) {
            collect(row);
            for (const auto& [i, x] : entries)
                for (const auto& [j, z] : entries)
                    if (i <= j) m_border(i, j) += x * z;
            for (std::size_t n = 0; n < m_nested.size(); ++n) {
                const std::size_t i = localOf[n][terms[m_nested[n]].group.of[row]];
                for (const auto& [column, value] : entries) block.coupling(i, place[column]) += value;
                for (std::size_t m = 0; m < m_nested.size(); ++m)
                    block.products(i, localOf[m][terms[m_nested[m]].group.of[row]]) += 1;
            }
        }
        for (const std::uint32_t column : block.border) place[column] = nowhere;
    }
}

Matrix BlockEquations::scaledProducts(const Block& block, std::span<const double> theta) const
{
    Matrix result = block.products;
    for (std::size_t n = 0; n < m_nested.size(); ++n)
        for (std::size_t i = block.starts[n]; i < block.starts[n + 1]; ++i)
            for (std::size_t m = 0; m < m_nested.size(); ++m)
                for (std::size_t j = block.starts[m]; j < block.starts[m + 1]; ++j)
                    result(i, j) = theta[m_nested[n]] * theta[m_nested[m]] * result(i, j) + (i == j ? 1 : 0);
    return result;
}

/// Factors of the columns of the border: theta for random columns, 1 for the fixed effects and y.
std::vector<double> BlockEquations::borderScale(std::span<const double> theta) const
{
    std::vector<double> scale(m_border.rows(), 1);
    for (const std::size_t t : m_across)
        std::fill_n(scale.begin() + static_cast<std::ptrdiff_t>(m_terms[t].firstColumn), m_terms[t].levels, theta[t]);
    return scale;
}

Matrix BlockEquations::scaledCoupling(const Block& block, std::span<const double> theta) const
{
    const std::vector<double> scale = borderScale(theta);
    Matrix result = block.coupling;
    for (std::size_t n = 0; n < m_nested.size(); ++n)
        for (std::size_t i = block.starts[n]; i < block.starts[n + 1]; ++i)
            for (std::size_t k = 0; k < block.border.size(); ++k) result(i, k) *= theta[m_nested[n]] * scale[block.border[k]];
    return result;
}

Matrix BlockEquations::scaledBorder(std::span<const double> theta) const
{
    const std::vector<double> scale = borderScale(theta);
    Matrix result = m_border;
    for (std::size_t i = 0; i < result.rows(); ++i)
        for (std::size_t j = i; j < result.columns(); ++j)
            result(i, j) = scale[i] * scale[j] * result(i, j) + (i == j && i < m_acrossColumns ? 1 : 0);
    return result;
}

BlockEquations::Parts BlockEquations::partsAt(std::span<const double> theta) const
{
    Parts parts;
    CriterionParts& criterion = parts.criterion;
    criterion.theta.assign(theta.begin(), theta.end());
    parts.upper = scaledBorder(theta);
    for (const Block& block : m_blocks) {
        Matrix upper = scaledProducts(block, theta);
        const std::size_t order = upper.rows();
        if (factorise(upper) < order) return parts;
        for (std::size_t i = 0; i < order; ++i) criterion.logDetRandom += 2 * std::log(upper(i, i));
        const Matrix lowerInverse = inverseOfTransposed(upper, order);
        const Matrix half = multiplied(lowerInverse, scaledCoupling(block, theta));
        const std::size_t width = block.border.size();
        Matrix squares(width, width);
        if (order > 0) addProducts(squares.row(0).data(), half.row(0).data(), order, width);
        for (std::size_t a = 0; a < width; ++a)
            for (std::size_t b = a; b < width; ++b) parts.upper(block.border[a], block.border[b]) -= squares(a, b);
        parts.blocks.push_back({inverseFrom(lowerInverse, order), multiplied(transposed(lowerInverse), half)});
    }
    const std::size_t size = parts.upper.rows();
    if (factorise(parts.upper) < size) return parts;
    for (std::size_t i = 0; i + 1 < size; ++i)
        (i < m_acrossColumns ? criterion.logDetRandom : criterion.logDetFixed) += 2 * std::log(parts.upper(i, i));
    criterion.residual = parts.upper(size - 1, size - 1) * parts.upper(size - 1, size - 1);
    criterion.exists = std::isfinite(criterion.residual);
    return parts;
}

CriterionParts BlockEquations::criterionAt(std::span<const double> theta) const { return partsAt(theta).criterion; }

/// `inverse`: inverse of the border, [random columns and fixed effects].
BlockEquations::TraceSums BlockEquations::traceSums(const Parts& parts, const Matrix& inverse) const
{
    const std::size_t order = inverse.rows();
    TraceSums sums;
    sums.own = Matrix(m_nested.size(), m_nested.size());
    sums.traces.assign(m_nested.size(), 0);
    sums.squares.assign(m_nested.size(), Matrix(order, order));
    for (std::size_t b = 0; b < m_blocks.size(); ++b) {
        const Block& block = m_blocks[b];
        const std::size_t width = block.border.size() - 1;  // without y
        const std::size_t own = block.starts.back();
        Matrix coupling(own, width), part(width, width);
        for (std::size_t i = 0; i < own; ++i)
            std::copy_n(parts.blocks[b].coupling.row(i).begin(), width, coupling.row(i).begin());
        for (std::size_t i = 0; i < width; ++i)
            for (std::size_t j = 0; j < width; ++j) part(i, j) = inverse(block.border[i], block.border[j]);
        const Matrix through = multiplied(coupling, part);
        for (std::size_t k = 0; k < m_nested.size(); ++k) {
            const std::size_t first = block.starts[k], count = block.starts[k + 1] - first;
            Matrix squares(width, width);
            addProducts(squares.row(0).data(), coupling.row(first).data(), count, width);
            for (std::size_t i = 0; i < width; ++i)
                for (std::size_t j = i; j < width; ++j) sums.squares[k](block.border[i], block.border[j]) += squares(i, j);
            for (std::size_t l = 0; l < m_nested.size(); ++l)
                for (std::size_t i = first; i < first + count; ++i)
                    for (std::size_t j = block.starts[l]; j < block.starts[l + 1]; ++j) {
                        const double e = (i == j ? 1 : 0) - parts.blocks[b].inverse(i, j);
                        if (i == j) sums.traces[k] += e;
                        sums.own(k, l) += e * (e - 2 * dot(through.row(i), coupling.row(j)));
                    }
        }
    }
    for (Matrix& squares : sums.squares) {
        for (std::size_t i = 0; i < order; ++i)
            for (std::size_t j = 0; j < i; ++j) squares(i, j) = squares(j, i);
        sums.transformed.push_back(multiplied(inverse, squares));
    }
    return sums;
}

/// Traces from the blocks of I - K, where K is the random part of the inverse of the whole system: I - D^-1 - G S G' within
/// a block, - G S G' between two blocks, G S between a block and the border, I - S within the border.
void BlockEquations::putTraces(VarianceDerivatives& result, const TraceSums& sums, const Matrix& inverse,
                               std::span<const double> theta) const
{
    const auto columnsOf = [&](std::size_t t) {
        return std::pair(m_terms[t].firstColumn, m_terms[t].firstColumn + m_terms[t].levels);
    };
    const auto put = [&](std::size_t t, std::size_t u, double sum) {
        result.traceProducts(t, u) = result.traceProducts(u, t) = sum / (theta[t] * theta[t] * theta[u] * theta[u]);
    };
    for (std::size_t k = 0; k < m_nested.size(); ++k) {
        const Matrix& own = sums.transformed[k];
        double trace = sums.traces[k];
        for (std::size_t i = 0; i < own.rows(); ++i) trace -= own(i, i);
        result.traces[m_nested[k]] = trace / (theta[m_nested[k]] * theta[m_nested[k]]);
        for (std::size_t l = 0; l <= k; ++l) {
            double sum = sums.own(k, l);
            for (std::size_t i = 0; i < own.rows(); ++i)
                for (std::size_t j = 0; j < own.rows(); ++j) sum += own(i, j) * sums.transformed[l](j, i);
            put(m_nested[k], m_nested[l], sum);
        }
        for (const std::size_t t : m_across) {
            double sum = 0;
            for (auto [c, end] = columnsOf(t); c < end; ++c) sum += dot(own.row(c), inverse.row(c));
            put(m_nested[k], t, sum);
        }
    }
    for (const std::size_t t : m_across) {
        for (auto [c, end] = columnsOf(t); c < end; ++c) result.traces[t] += (1 - inverse(c, c)) / (theta[t] * theta[t]);
        for (const std::size_t u : m_across) {
            double sum = 0;
            for (auto [c, end] = columnsOf(t); c < end; ++c)
                for (auto [d, last] = columnsOf(u); d < last; ++d) {
                    const double e = (c == d ? 1 : 0) - inverse(c, d);
                    sum += e * e;
                }
            put(t, u, sum);
        }
    }
}

/// Forms from the random effects u = Lambda'Z'Py and from (I - K) u of each term.
void BlockEquations::putForms(VarianceDerivatives& result, const Parts& parts, const Matrix& inverse,
                              std::span<const double> solution, std::span<const double> theta) const
{
    const std::size_t order = inverse.rows();
    std::vector<std::vector<double>> effects;  // of the columns of each block
    for (std::size_t b = 0; b < m_blocks.size(); ++b) {
        const Matrix& coupling = parts.blocks[b].coupling;
        effects.emplace_back(coupling.rows());
        for (std::size_t i = 0; i < coupling.rows(); ++i) {
            effects[b][i] = coupling(i, coupling.columns() - 1);
            for (std::size_t k = 0; k + 1 < coupling.columns(); ++k)
                effects[b][i] -= coupling(i, k) * solution[m_blocks[b].border[k]];
        }
    }
    for (std::size_t l = 0; l < m_terms.size(); ++l) {
        const auto nested = std::ranges::find(m_nested, l);
        const bool isNested = nested != m_nested.end();
        const auto place = static_cast<std::size_t>(nested - m_nested.begin());
        std::vector<double> right(order);
        for (std::size_t b = 0; isNested && b < m_blocks.size(); ++b)
            for (std::size_t i = m_blocks[b].starts[place]; i < m_blocks[b].starts[place + 1]; ++i)
                for (std::size_t k = 0; k + 1 < m_blocks[b].border.size(); ++k)
                    right[m_blocks[b].border[k]] += parts.blocks[b].coupling(i, k) * effects[b][i];
        if (!isNested)
            for (std::size_t c = m_terms[l].firstColumn; c < m_terms[l].firstColumn + m_terms[l].levels; ++c)
                right[c] = solution[c];
        const std::vector<double> through = product(inverse, right);
        const double sign = isNested ? -1 : 1;
        for (std::size_t n = 0; n < m_nested.size(); ++n)
            for (std::size_t b = 0; b < m_blocks.size(); ++b)
                for (std::size_t i = m_blocks[b].starts[n]; i < m_blocks[b].starts[n + 1]; ++i) {
                    double sum = isNested && n == place ? effects[b][i] : 0;
                    for (std::size_t j = m_blocks[b].starts[isNested ? place : 0]; isNested && j < m_blocks[b].starts[place + 1];
                         ++j)
                        sum -= parts.blocks[b].inverse(i, j) * effects[b][j];
                    for (std::size_t k = 0; k + 1 < m_blocks[b].border.size(); ++k)
                        sum += sign * parts.blocks[b].coupling(i, k) * through[m_blocks[b].border[k]];
                    result.formProducts(m_nested[n], l) += effects[b][i] * sum;
                    if (isNested && n == place) result.forms[l] += effects[b][i] * effects[b][i];
                }
        for (const std::size_t t : m_across)
            for (std::size_t c = m_terms[t].firstColumn; c < m_terms[t].firstColumn + m_terms[t].levels; ++c) {
                const double sum = isNested ? through[c] : (t == l ? solution[c] : 0) - through[c];
                result.formProducts(t, l) += solution[c] * sum;
                if (t == l) result.forms[l] += solution[c] * solution[c];
            }
    }
    for (std::size_t k = 0; k < m_terms.size(); ++k) {
        result.forms[k] /= theta[k] * theta[k];
        for (std::size_t l = 0; l < m_terms.size(); ++l) result.formProducts(k, l) /= theta[k] * theta[k] * theta[l] * theta[l];
    }
}

void BlockEquations::putFixedCovariances(VarianceDerivatives& result, const TraceSums& sums, const Matrix& inverse,
                                         std::span<const double> theta) const
{
    Matrix fixed(m_fixed, inverse.columns());
    for (std::size_t i = 0; i < m_fixed; ++i) std::ranges::copy(inverse.row(m_acrossColumns + i), fixed.row(i).begin());
    for (std::size_t t = 0; t < m_terms.size(); ++t) {
        const auto nested = std::ranges::find(m_nested, t);
        Matrix left = fixed;
        if (nested != m_nested.end())
            left = multiplied(fixed, sums.squares[static_cast<std::size_t>(nested - m_nested.begin())]);
        else
            for (std::size_t i = 0; i < m_fixed; ++i)
                for (std::size_t c = 0; c < left.columns(); ++c)
                    if (c < m_terms[t].firstColumn || c >= m_terms[t].firstColumn + m_terms[t].levels) left(i, c) = 0;
        Matrix& derivative = result.fixedCovariance.emplace_back(m_fixed, m_fixed);
        for (std::size_t i = 0; i < m_fixed; ++i)
            for (std::size_t j = 0; j < m_fixed; ++j) derivative(i, j) = dot(left.row(i), fixed.row(j)) / (theta[t] * theta[t]);
    }
}

SystemSolution BlockEquations::solutionAt(std::span<const double> theta, bool reml) const
{
    const Parts parts = partsAt(theta);
    const std::size_t order = m_acrossColumns + m_fixed;
    const Matrix lowerInverse = inverseOfTransposed(parts.upper, order);
    const Matrix inverse = inverseFrom(lowerInverse, order);
    std::vector<double> solution(order);
    for (std::size_t k = 0; k < order; ++k)
        for (std::size_t i = 0; i <= k; ++i) solution[i] += lowerInverse(k, i) * parts.upper(k, order);

    SystemSolution result;
    result.fixed.assign(solution.begin() + static_cast<std::ptrdiff_t>(m_acrossColumns), solution.end());
    result.fixedCovariance = Matrix(m_fixed, m_fixed);
    for (std::size_t i = 0; i < m_fixed; ++i)
        for (std::size_t j = 0; j < m_fixed; ++j)
            result.fixedCovariance(i, j) = inverse(m_acrossColumns + i, m_acrossColumns + j);
    VarianceDerivatives& derivatives = result.derivatives;
    derivatives.traces.assign(m_terms.size(), 0);
    derivatives.forms.assign(m_terms.size(), 0);
    derivatives.traceProducts = derivatives.formProducts = Matrix(m_terms.size(), m_terms.size());
    const Matrix ofTraces = reml ? inverse : leading(inverseFrom(lowerInverse, m_acrossColumns), order);
    const TraceSums sums = traceSums(parts, ofTraces);
    putTraces(derivatives, sums, ofTraces, theta);
    putForms(derivatives, parts, inverse, solution, theta);
    putFixedCovariances(derivatives, sums, inverse, theta);
    return result;
}

}  // namespace stats
