// The mixed-model equations of large incomplete data with random intercepts. The rows fall into blocks, the levels of one
// factor (participants, or conditions). The terms nested in it have their own columns in each block; the other terms, the
// fixed effects and y are the border. Eliminating the blocks one by one leaves a dense matrix of the border only. The
// derivatives need no matrix of all random effects either: between blocks, Z'PZ has the rank of the border.
#pragma once

#include <cstdint>

#include "stats/models/mixed_model_equations.h"
#include "stats/models/mixed_model_system.h"
#include "stats/models/row_blocks.h"

namespace stats {

class BlockEquations : public MixedModelSystem {
public:
    /// Terms of intercepts only.
    BlockEquations(std::span<const double> y, const FixedEffects& fixed, std::span<const RandomTerm> terms,
                   const RowBlocks& blocks);

    CriterionParts criterionAt(std::span<const double> theta) const override;
    SystemSolution solutionAt(std::span<const double> theta, bool reml) const override;

private:
    /// Columns of one block, term by term.
    struct Block {
        std::vector<std::size_t> starts;    ///< for each nested term: its first column; then their number
        std::vector<std::uint32_t> border;  ///< columns of the border that have rows in this block; y is the last
        Matrix products;                    ///< products of the columns with themselves
        Matrix coupling;                    ///< products of the columns with the border
    };
    /// Inverse of a block, and the inverse times its coupling; both scaled by theta.
    struct SolvedBlock {
        Matrix inverse;
        Matrix coupling;
    };
    struct Parts;
    struct TraceSums;

    void addRows(std::span<const double> y, const FixedEffects& fixed, std::span<const RandomTerm> terms,
                 const RowBlocks& blocks);
    Matrix scaledProducts(const Block& block, std::span<const double> theta) const;
    Matrix scaledCoupling(const Block& block, std::span<const double> theta) const;
    Matrix scaledBorder(std::span<const double> theta) const;
    std::vector<double> borderScale(std::span<const double> theta) const;
    Parts partsAt(std::span<const double> theta) const;
    TraceSums traceSums(const Parts& parts, const Matrix& inverse) const;
    void putTraces(VarianceDerivatives& result, const TraceSums& sums, const Matrix& inverse,
                   std::span<const double> theta) const;
    void putForms(VarianceDerivatives& result, const Parts& parts, const Matrix& inverse, std::span<const double> solution,
                  std::span<const double> theta) const;
    void putFixedCovariances(VarianceDerivatives& result, const TraceSums& sums, const Matrix& inverse,
                             std::span<const double> theta) const;

    std::vector<std::size_t> m_nested;  ///< terms within the blocks
    std::vector<std::size_t> m_across;  ///< terms of the border
    std::size_t m_acrossColumns = 0;    ///< random columns of the border, which are its first
    std::vector<Block> m_blocks;
    Matrix m_border;  ///< products of the border with itself, upper triangle: random columns, fixed effects, y
};

}  // namespace stats
