// The columns of crossed random intercepts, one for each level of each group, divided into blocks and a border. Levels of
// groups in the border aside, columns are in one block where rows connect them: the levels of participant:condition of one
// participant, or those of one condition.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "stats/kernels/bordered_blocks.h"
#include "stats/models/factor.h"

namespace stats {

class RandomColumns {
public:
    /// Takes the division that makes a Cholesky factor cheapest.
    RandomColumns(std::span<const Factor> groups, std::size_t rows);

    std::size_t count() const { return m_termOf.size(); }
    std::size_t terms() const { return m_terms; }
    std::uint32_t termOf(std::size_t column) const { return m_termOf[column]; }
    /// Column of each term in a row.
    const std::uint32_t* of(std::size_t row) const { return m_columns.data() + row * m_terms; }
    /// Rows in the order of their blocks: work in this order stays within a small part of the matrix for long.
    std::vector<std::uint32_t> rowsByBlock() const;
    const BorderedShape& shape() const { return m_shape; }
    /// Multiplications of one Cholesky factor, at most.
    double cost() const { return m_cost; }

private:
    struct Division {
        std::vector<std::uint32_t> blockOf;
        double cost = 0;
    };
    Division dividedBy(const std::vector<bool>& termInBorder) const;

    std::size_t m_terms = 0;
    std::size_t m_rows = 0;
    std::vector<std::uint32_t> m_columns;  ///< [rows x terms]
    std::vector<std::uint32_t> m_termOf;   ///< of each column
    BorderedShape m_shape;
    double m_cost = 0;
};

}  // namespace stats
