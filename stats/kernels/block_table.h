// A complete table of blocks (participants) by conditions.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "stats/kernels/value.h"

namespace stats {

/// Row-major [blocks x conditions].
struct BlockTable {
    std::size_t blocks = 0;
    std::size_t conditions = 0;
    std::vector<double> values;

    double at(std::size_t block, std::size_t condition) const { return values[block * conditions + condition]; }
    std::span<const double> row(std::size_t block) const { return std::span(values).subspan(block * conditions, conditions); }
    std::vector<double> column(std::size_t condition) const
    {
        std::vector<double> result(blocks);
        for (std::size_t block = 0; block < blocks; ++block) result[block] = at(block, condition);
        return result;
    }
};

/// A table made of rows of equal length; `fault` says why there is none.
struct BlockTableResult {
    BlockTable table;
    std::string fault;
};
BlockTableResult blockTableOf(const std::vector<std::vector<double>>& rows);

}  // namespace stats
