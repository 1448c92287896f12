#include "stats/kernels/matrix.h"

#include <algorithm>
#include <cmath>

#include "stats/kernels/vector_clones.h"

namespace stats {
namespace {

// Relative to its diagonal element, a pivot below this is the rounding error of a linearly dependent column.
constexpr double dependent = 1e-11;

/// target[from...] -= factor * source[from...]
void subtract(std::span<double> target, std::span<const double> source, double factor, std::size_t from, std::size_t to)
{
    for (std::size_t j = from; j < to; ++j) target[j] -= factor * source[j];
}

/// Rotates two rows.
STATS_VECTOR_CLONES void rotateRows(double* p, double* q, std::size_t n, double c, double s)
{
    for (std::size_t k = 0; k < n; ++k) {
        const double x = p[k];
        const double y = q[k];
        p[k] = c * x - s * y;
        q[k] = s * x + c * y;
    }
}

/// Rotates a symmetric matrix in the plane (p, q) so that element (p, q) becomes zero.
void rotate(Matrix& a, Matrix& vectors, std::size_t p, std::size_t q)
{
    const double theta = (a(q, q) - a(p, p)) / (2 * a(p, q));
    const double t = (theta < 0 ? -1 : 1) / (std::fabs(theta) + std::sqrt(theta * theta + 1));
    const double c = 1 / std::sqrt(t * t + 1);
    const double s = t * c;
    const std::size_t n = a.rows();
    for (const std::size_t k : {p, q}) {  // their rows are rotated below
        const double x = a(k, p);
        const double y = a(k, q);
        a(k, p) = c * x - s * y;
        a(k, q) = s * x + c * y;
    }
    rotateRows(a.row(p).data(), a.row(q).data(), n, c, s);
    rotateRows(vectors.row(p).data(), vectors.row(q).data(), n, c, s);
    for (std::size_t k = 0; k < n; ++k) {  // all other rows by symmetry
        if (k == p || k == q) continue;
        a(k, p) = a(p, k);
        a(k, q) = a(q, k);
    }
}

}  // namespace

std::size_t factorise(Matrix& matrix)
{
    const std::size_t n = matrix.rows();
    std::vector<double> diagonal(n);
    for (std::size_t k = 0; k < n; ++k) diagonal[k] = matrix(k, k);
    for (std::size_t k = 0; k < n; ++k) {
        const auto pivotRow = matrix.row(k);
        if (!(pivotRow[k] > dependent * diagonal[k])) return k;
        pivotRow[k] = std::sqrt(pivotRow[k]);
        const double scale = 1 / pivotRow[k];
        for (std::size_t j = k + 1; j < n; ++j) pivotRow[j] *= scale;
        for (std::size_t i = k + 1; i < n; ++i)
            if (pivotRow[i] != 0) subtract(matrix.row(i), pivotRow, pivotRow[i], i, n);
    }
    return n;
}

Matrix inverseOfTransposed(const Matrix& upper, std::size_t order)
{
    Matrix inverse(order, order);
    for (std::size_t i = 0; i < order; ++i) {
        const auto row = inverse.row(i);
        for (std::size_t k = 0; k < i; ++k)
            if (upper(k, i) != 0) subtract(row, inverse.row(k), upper(k, i), 0, k + 1);
        row[i] = 1;
        for (std::size_t j = 0; j <= i; ++j) row[j] /= upper(i, i);
    }
    return inverse;
}

Matrix inverseFrom(const Matrix& lowerInverse, std::size_t order)
{
    Matrix inverse(order, order);
    for (std::size_t k = 0; k < order; ++k) {
        const auto row = lowerInverse.row(k);
        for (std::size_t i = 0; i <= k; ++i)
            if (row[i] != 0) subtract(inverse.row(i), row, -row[i], 0, i + 1);
    }
    for (std::size_t i = 0; i < order; ++i)
        for (std::size_t j = 0; j < i; ++j) inverse(j, i) = inverse(i, j);
    return inverse;
}

std::vector<double> solved(Matrix symmetric, std::span<const double> right)
{
    const std::size_t n = right.size();
    if (factorise(symmetric) < n) return {};
    const Matrix lowerInverse = inverseOfTransposed(symmetric, n);
    const auto half = product(lowerInverse, right);
    std::vector<double> result(n);
    for (std::size_t k = 0; k < n; ++k)
        for (std::size_t i = 0; i <= k; ++i) result[i] += lowerInverse(k, i) * half[k];
    return result;
}

Eigen eigenOf(Matrix symmetric)
{
    const std::size_t n = symmetric.rows();
    Eigen eigen{std::vector<double>(n), Matrix(n, n)};
    for (std::size_t i = 0; i < n; ++i) eigen.vectors(i, i) = 1;
    for (int sweep = 0; sweep < 60; ++sweep) {
        double off = 0;
        double whole = 0;
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t j = 0; j < n; ++j) (i == j ? whole : off) += symmetric(i, j) * symmetric(i, j);
        if (off <= 1e-34 * whole) break;
        for (std::size_t p = 0; p < n; ++p)
            for (std::size_t q = p + 1; q < n; ++q)
                if (symmetric(p, q) != 0) rotate(symmetric, eigen.vectors, p, q);
    }
    for (std::size_t i = 0; i < n; ++i) eigen.values[i] = symmetric(i, i);
    return eigen;
}

double dot(std::span<const double> a, std::span<const double> b)
{
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
    return sum;
}

std::vector<double> product(const Matrix& matrix, std::span<const double> vector)
{
    std::vector<double> result(matrix.rows());
    for (std::size_t i = 0; i < result.size(); ++i) result[i] = dot(matrix.row(i), vector);
    return result;
}

double quadraticForm(std::span<const double> a, const Matrix& matrix, std::span<const double> b)
{
    return dot(a, product(matrix, b));
}

}  // namespace stats
