// Small dense matrices for the mixed models: Cholesky factor, inverse and eigenvectors. Every inner loop runs
// along a row, and no sum is reordered.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace stats {

/// Row-major [rows x columns], zero at first.
class Matrix {
public:
    Matrix() = default;
    Matrix(std::size_t rows, std::size_t columns) : m_columns(columns), m_values(rows * columns) {}

    std::size_t columns() const { return m_columns; }
    std::size_t rows() const { return m_columns == 0 ? 0 : m_values.size() / m_columns; }
    double& operator()(std::size_t row, std::size_t column) { return m_values[row * m_columns + column]; }
    double operator()(std::size_t row, std::size_t column) const { return m_values[row * m_columns + column]; }
    std::span<double> row(std::size_t index) { return std::span(m_values).subspan(index * m_columns, m_columns); }
    std::span<const double> row(std::size_t index) const { return std::span(m_values).subspan(index * m_columns, m_columns); }

    bool operator==(const Matrix&) const = default;

private:
    std::size_t m_columns = 0;
    std::vector<double> m_values;
};

/// Replaces the upper triangle of a symmetric matrix by its Cholesky factor U, U'U = matrix. The lower triangle
/// is neither read nor written. Returns the number of columns done: all, or the index of the first column that
/// depends linearly, up to rounding, on those before it.
std::size_t factorise(Matrix& matrix);

/// Inverse of U' (lower triangular) for the leading `order` columns of the Cholesky factor U.
Matrix inverseOfTransposed(const Matrix& upper, std::size_t order);

/// (U'U)^-1 of the leading `order` columns as a full symmetric matrix, from the inverse of U'.
Matrix inverseFrom(const Matrix& lowerInverse, std::size_t order);

/// Solution of a symmetric positive definite system; empty where the matrix is singular.
std::vector<double> solved(Matrix symmetric, std::span<const double> right);

struct Eigen {
    std::vector<double> values;
    Matrix vectors;  ///< one eigenvector a row
};
/// Eigenvalues and eigenvectors of a symmetric matrix, by Jacobi rotations.
Eigen eigenOf(Matrix symmetric);

double dot(std::span<const double> a, std::span<const double> b);
/// matrix * vector
std::vector<double> product(const Matrix& matrix, std::span<const double> vector);
/// a' matrix b
double quadraticForm(std::span<const double> a, const Matrix& matrix, std::span<const double> b);

}  // namespace stats
