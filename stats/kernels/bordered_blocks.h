// A symmetric matrix of blocks that touch each other through a border only:
//
//     | A1       B1 |
//     |    A2    B2 |
//     | B1' B2'  D  |
//
// Factor, determinant, solution, and the part of the inverse where the matrix has entries (Golub & Van Loan, Matrix
// Computations, block elimination). The work grows with the number of blocks, and with the cube of the sizes of one block and
// of the border.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace stats {

/// Which columns form the blocks and the border, and where their entries are stored.
class BorderedShape {
public:
    static constexpr std::uint32_t inBorder = UINT32_MAX;

    BorderedShape() = default;
    /// `blockOf`: block of each column, 0 to blocks - 1, or inBorder. Columns of a block are eliminated in their order.
    explicit BorderedShape(std::span<const std::uint32_t> blockOf);

    std::size_t columns() const { return m_blockOf.size(); }
    std::size_t blocks() const { return m_sizes.size(); }
    std::size_t border() const { return m_border; }
    /// Block of a column, or inBorder.
    std::uint32_t blockOf(std::size_t column) const { return m_blockOf[column]; }
    /// Number of stored entries: the upper triangles and the rectangles beside the border.
    std::size_t entries() const { return m_entries; }
    /// Place of an entry, in either order of the columns. Two columns of different blocks have none.
    std::size_t place(std::uint32_t a, std::uint32_t b) const;

private:
    friend class BorderedFactor;
    std::size_t m_border = 0;
    std::size_t m_entries = 0;
    std::size_t m_borderStart = 0;            ///< place of D [border x border]
    std::vector<std::uint32_t> m_blockOf;     ///< of each column
    std::vector<std::uint32_t> m_positionOf;  ///< of each column within its block or the border
    std::vector<std::size_t> m_sizes;         ///< of each block
    std::vector<std::size_t> m_starts;        ///< place of A [size x size], which B [size x border] follows
};

/// Multiplications that a factor of blocks of these sizes takes at most.
double factorCost(std::span<const std::size_t> sizes, std::size_t border);

/// Cholesky factor.
class BorderedFactor {
public:
    /// `entries`: the matrix in the places of the shape, which must live as long as the factor.
    BorderedFactor(const BorderedShape& shape, std::vector<double> entries);

    /// False where the matrix is not positive definite.
    bool exists() const { return m_exists; }
    double logDeterminant() const;
    /// Solution of matrix * x = right.
    std::vector<double> solved(std::span<const double> right) const;
    /// The inverse, in the places of the shape.
    std::vector<double> inverse() const;

private:
    bool eliminate(std::size_t block);
    void invertBlock(std::size_t block, const std::vector<double>& border, std::vector<double>& result) const;

    const BorderedShape& m_shape;
    std::vector<double> m_values;  ///< U of each block with U'^-1 B beside it, and U of the border's Schur complement
    bool m_exists = false;
};

}  // namespace stats
