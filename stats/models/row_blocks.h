// Division of the rows of a mixed model into blocks, the levels of one factor. Columns that lie in one block only are eliminated
// block by block (see mixed_model_blocks.h).
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "stats/models/mixed_model_equations.h"

namespace stats {

/// Division of the rows into blocks.
struct RowBlocks {
    std::vector<std::size_t> of;  ///< block of each row
    std::size_t count = 0;
    std::vector<bool> nested;  ///< for each term: every level lies in one block
    double work = 0;           ///< operations of one solution, about
};

/// The division by the levels of a term, or of a treatment-coded factor of the fixed effects, that needs the least work.
RowBlocks cheapestBlocks(const FixedEffects& fixed, std::span<const RandomTerm> terms);

/// The rows of each block, in their order.
std::vector<std::vector<std::size_t>> rowsByBlock(const RowBlocks& blocks);

/// The nonzero entries of the fixed effects, row by row.
struct FixedRows {
    std::vector<std::size_t> starts{0};
    std::vector<std::size_t> columns;
    std::vector<double> values;
};

FixedRows fixedRows(const FixedEffects& fixed);

}  // namespace stats
