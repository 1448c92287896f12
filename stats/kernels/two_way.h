// A table of blocks by conditions taken apart: grand mean + block effect + condition effect + residual.
// What repeated-measures analysis, sphericity, within-subject intervals and intraclass correlations share.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "stats/kernels/block_table.h"

namespace stats {

/// In the power-of-two scale of the table (ScaledSamples).
struct TwoWayEffects {
    std::size_t blocks = 0;
    std::size_t conditions = 0;
    std::vector<double> block;
    std::vector<double> condition;
    std::vector<double> residual;  ///< row-major [blocks x conditions]
    double ssBlock = 0;
    double ssCondition = 0;
    double ssResidual = 0;

    double residualAt(std::size_t i, std::size_t j) const { return residual[i * conditions + j]; }
    /// The residuals are no larger than what rounding to doubles leaves of a table without any.
    bool hasNoResiduals() const;
    /// The same for all effects: every value of the table is the same.
    bool isConstant() const;

    double grain = 0;  ///< distance between neighbouring doubles at the table's largest value
};

/// `scaled`: the values of a table of this shape.
TwoWayEffects twoWayEffects(std::span<const double> scaled, const BlockTable& shape);

/// Fewer than 2 conditions or blocks, a value that is not finite; empty when there is none.
std::string twoWayFault(const BlockTable& table);

}  // namespace stats
