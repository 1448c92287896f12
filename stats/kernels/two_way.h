// Decomposes a table of blocks by conditions: grand mean + block effect + condition effect + residual.
// Repeated-measures analysis, sphericity, within-subject intervals and intraclass correlations use it.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "stats/kernels/block_table.h"

namespace stats {

/// All effects in the power-of-two scale of the table (ScaledSamples).
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
    /// True where the residuals are no larger than the rounding errors of a table without residuals.
    bool hasNoResiduals() const;
    /// True where every value of the table is the same, up to rounding.
    bool isConstant() const;

    double grain = 0;  ///< distance between neighbouring doubles at the table's largest value
};

/// Decomposes the values `scaled` of a table of this shape.
TwoWayEffects twoWayEffects(std::span<const double> scaled, const BlockTable& shape);

/// The reason against a decomposition: fewer than 2 conditions or blocks, a value that is not finite. Else empty.
std::string twoWayFault(const BlockTable& table);

}  // namespace stats
