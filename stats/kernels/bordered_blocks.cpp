#include "stats/kernels/bordered_blocks.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace stats {
namespace {

/// y += factor x
void addMultiple(double* y, double factor, const double* x, std::size_t n)
{
    for (std::size_t i = 0; i < n; ++i) y[i] += factor * x[i];
}

/// Upper Cholesky factor in place of the upper triangle of a [n x n]; false where a pivot is not positive.
bool factoriseSquare(double* a, std::size_t n)
{
    for (std::size_t k = 0; k < n; ++k) {
        double* const row = a + k * n;
        if (!(row[k] > 0)) return false;
        const double root = std::sqrt(row[k]);
        for (std::size_t j = k; j < n; ++j) row[j] /= root;
        for (std::size_t i = k + 1; i < n; ++i)
            if (row[i] != 0) addMultiple(a + i * n + i, -row[i], row + i, n - i);
    }
    return true;
}

/// U'^-1 applied to the rows of b [n x width], in place.
void solveForward(const double* upper, std::size_t n, double* b, std::size_t width)
{
    for (std::size_t r = 0; r < n; ++r) {
        for (std::size_t q = 0; q < r; ++q)
            if (const double u = upper[q * n + r]; u != 0) addMultiple(b + r * width, -u, b + q * width, width);
        for (std::size_t j = 0; j < width; ++j) b[r * width + j] /= upper[r * n + r];
    }
}

/// U^-1 applied to the rows of b [n x width], in place.
void solveBackward(const double* upper, std::size_t n, double* b, std::size_t width)
{
    for (std::size_t r = n; r-- > 0;) {
        for (std::size_t q = r + 1; q < n; ++q)
            if (const double u = upper[r * n + q]; u != 0) addMultiple(b + r * width, -u, b + q * width, width);
        for (std::size_t j = 0; j < width; ++j) b[r * width + j] /= upper[r * n + r];
    }
}

/// Full inverse of U'U.
std::vector<double> inverseOfSquare(const double* upper, std::size_t n)
{
    std::vector<double> inverse(n * n);
    for (std::size_t i = 0; i < n; ++i) inverse[i * n + i] = 1;
    solveForward(upper, n, inverse.data(), n);
    solveBackward(upper, n, inverse.data(), n);
    return inverse;
}

void nonzerosOf(const double* row, std::size_t n, std::vector<std::size_t>& places)
{
    places.clear();
    for (std::size_t j = 0; j < n; ++j)
        if (row[j] != 0) places.push_back(j);
}

double logOfDiagonal(const double* upper, std::size_t n)
{
    double sum = 0;
    for (std::size_t i = 0; i < n; ++i) sum += std::log(upper[i * n + i]);
    return sum;
}

}  // namespace

BorderedShape::BorderedShape(std::span<const std::uint32_t> blockOf) : m_blockOf(blockOf.begin(), blockOf.end())
{
    for (const std::uint32_t block : m_blockOf) {
        if (block != inBorder && block >= m_sizes.size()) m_sizes.resize(block + 1);
        m_positionOf.push_back(static_cast<std::uint32_t>(block == inBorder ? m_border++ : m_sizes[block]++));
    }
    for (const std::size_t size : m_sizes) {
        m_starts.push_back(m_entries);
        m_entries += size * (size + m_border);
    }
    m_borderStart = m_entries;
    m_entries += m_border * m_border;
}

std::size_t BorderedShape::place(std::uint32_t a, std::uint32_t b) const
{
    if (m_blockOf[a] == inBorder) std::swap(a, b);
    const std::size_t i = m_positionOf[a], j = m_positionOf[b];
    if (m_blockOf[a] == inBorder) return m_borderStart + std::min(i, j) * m_border + std::max(i, j);
    const std::size_t size = m_sizes[m_blockOf[a]], start = m_starts[m_blockOf[a]];
    return m_blockOf[b] == inBorder ? start + size * size + i * m_border + j : start + std::min(i, j) * size + std::max(i, j);
}

double factorCost(std::span<const std::size_t> sizes, std::size_t border)
{
    const double d = static_cast<double>(border);
    double cost = d * d * d / 6;
    for (const std::size_t size : sizes) {
        const double b = static_cast<double>(size);
        cost += b * b * b / 6 + b * b * d / 2 + b * d * d / 2;
    }
    return cost;
}

BorderedFactor::BorderedFactor(const BorderedShape& shape, std::vector<double> entries)
    : m_shape(shape), m_values(std::move(entries))
{
    for (std::size_t block = 0; block < shape.blocks(); ++block)
        if (!eliminate(block)) return;
    m_exists = factoriseSquare(m_values.data() + shape.m_borderStart, shape.m_border);
}

/// Factorises a block and subtracts B'A^-1 B from the border.
bool BorderedFactor::eliminate(std::size_t block)
{
    const std::size_t n = m_shape.m_sizes[block], d = m_shape.m_border;
    double* const a = m_values.data() + m_shape.m_starts[block];
    double* const beside = a + n * n;
    double* const border = m_values.data() + m_shape.m_borderStart;
    if (!factoriseSquare(a, n)) return false;
    solveForward(a, n, beside, d);
    // Most rows touch few columns of the border.
    std::vector<std::size_t> touched;
    for (std::size_t r = 0; r < n; ++r) {
        const double* const row = beside + r * d;
        nonzerosOf(row, d, touched);
        for (std::size_t i = 0; i < touched.size(); ++i) {
            double* const target = border + touched[i] * d;
            const double factor = row[touched[i]];
            if (2 * touched.size() > d)
                addMultiple(target + touched[i], -factor, row + touched[i], d - touched[i]);
            else
                for (std::size_t j = i; j < touched.size(); ++j) target[touched[j]] -= factor * row[touched[j]];
        }
    }
    return true;
}

double BorderedFactor::logDeterminant() const
{
    double sum = logOfDiagonal(m_values.data() + m_shape.m_borderStart, m_shape.m_border);
    for (std::size_t block = 0; block < m_shape.blocks(); ++block)
        sum += logOfDiagonal(m_values.data() + m_shape.m_starts[block], m_shape.m_sizes[block]);
    return 2 * sum;
}

std::vector<double> BorderedFactor::solved(std::span<const double> right) const
{
    const std::size_t d = m_shape.m_border;
    std::vector<double> border(d);
    std::vector<std::vector<double>> parts(m_shape.blocks());
    for (std::size_t block = 0; block < parts.size(); ++block) parts[block].resize(m_shape.m_sizes[block]);
    const auto placeOf = [&](std::size_t column) -> double& {
        const std::uint32_t block = m_shape.m_blockOf[column];
        return (block == BorderedShape::inBorder ? border : parts[block])[m_shape.m_positionOf[column]];
    };
    for (std::size_t column = 0; column < right.size(); ++column) placeOf(column) = right[column];
    for (std::size_t block = 0; block < parts.size(); ++block) {
        const std::size_t n = parts[block].size();
        const double* const a = m_values.data() + m_shape.m_starts[block];
        solveForward(a, n, parts[block].data(), 1);
        for (std::size_t r = 0; r < n; ++r) addMultiple(border.data(), -parts[block][r], a + n * n + r * d, d);
    }
    const double* const upper = m_values.data() + m_shape.m_borderStart;
    solveForward(upper, d, border.data(), 1);
    solveBackward(upper, d, border.data(), 1);
    for (std::size_t block = 0; block < parts.size(); ++block) {
        const std::size_t n = parts[block].size();
        const double* const a = m_values.data() + m_shape.m_starts[block];
        for (std::size_t r = 0; r < n; ++r)
            for (std::size_t j = 0; j < d; ++j) parts[block][r] -= a[n * n + r * d + j] * border[j];
        solveBackward(a, n, parts[block].data(), 1);
    }
    std::vector<double> result;
    for (std::size_t column = 0; column < right.size(); ++column) result.push_back(placeOf(column));
    return result;
}

std::vector<double> BorderedFactor::inverse() const
{
    const std::size_t d = m_shape.m_border;
    std::vector<double> result(m_shape.entries());
    const auto border = inverseOfSquare(m_values.data() + m_shape.m_borderStart, d);
    std::copy(border.begin(), border.end(), result.begin() + static_cast<std::ptrdiff_t>(m_shape.m_borderStart));
    for (std::size_t block = 0; block < m_shape.blocks(); ++block) invertBlock(block, border, result);
    return result;
}

/// With C = U'^-1 B and the border's inverse S: beside the border -U^-1 C S, in the block U^-1 (I + C S C') U'^-1.
void BorderedFactor::invertBlock(std::size_t block, const std::vector<double>& border, std::vector<double>& result) const
{
    const std::size_t n = m_shape.m_sizes[block], d = m_shape.m_border;
    const double* const upper = m_values.data() + m_shape.m_starts[block];
    const double* const c = upper + n * n;
    double* const inner = result.data() + m_shape.m_starts[block];
    double* const beside = inner + n * n;
    std::vector<std::size_t> touched;
    for (std::size_t r = 0; r < n; ++r) {
        nonzerosOf(c + r * d, d, touched);
        for (const std::size_t j : touched) addMultiple(beside + r * d, -c[r * d + j], border.data() + j * d, d);
    }
    // Rows of -C S are complete; their products with C give the block.
    for (std::size_t i = 0; i < n; ++i) {
        nonzerosOf(c + i * d, d, touched);
        for (std::size_t r = 0; r < n; ++r) {
            double sum = i == r ? 1 : 0;
            for (const std::size_t j : touched) sum -= beside[r * d + j] * c[i * d + j];
            inner[r * n + i] = sum;
        }
    }
    solveBackward(upper, n, beside, d);
    solveBackward(upper, n, inner, n);
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < i; ++j) std::swap(inner[i * n + j], inner[j * n + i]);
    solveBackward(upper, n, inner, n);
}

}  // namespace stats
