// Henderson's mixed-model equations of a linear mixed model, solved for many values of theta, the relative covariance
// parameters (Bates et al. 2015, J. Stat. Softw. 67(1)), for any data:
//
//     | Lambda'Z'Z Lambda + I   Lambda'Z'X |
//     | X'Z Lambda              X'X        |      V = sigma^2 (Z Lambda Lambda' Z' + I)
//
// The cross-products are computed once. The term with the most levels is a diagonal block, which is eliminated row by
// row; only the remaining Schur complement, bordered by y, has a dense Cholesky factor.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "stats/kernels/matrix.h"
#include "stats/models/factor.h"
#include "stats/models/mixed_model_system.h"

namespace stats {

/// A random intercept for each level of a group and, where there is a covariate, a random slope correlated with it.
struct RandomTerm {
    Factor group;
    std::vector<double> slope;  ///< covariate of each row; empty: intercepts only
    std::string slopeName;
};

/// Cholesky factor of the equations for one theta; the criterion needs no more.
struct Factorised : CriterionParts {
    std::vector<double> pivots;     ///< pivots of the eliminated columns
    std::vector<double> bordering;  ///< scaled rows of these columns, in the order of the sparse cross-products
    Matrix upper;                   ///< Cholesky factor of the rest, the fixed effects and y
};

/// Solution of the equations, sigma = 1.
struct Solved {
    std::vector<double> fixed;  ///< estimates
    Matrix fixedCovariance;     ///< C = (X'V^-1 X)^-1
    Matrix fixedOnRandom;       ///< C X'V^-1 Z  [fixed x random]
    Matrix projected;           ///< Z'PZ
    Matrix weighted;            ///< Z'V^-1 Z; empty unless asked for
    std::vector<double> score;  ///< Z'Py
};

class MixedModelEquations : public MixedModelSystem {
public:
    /// All columns have the same length, all numbers are finite, and slopes have a size near 1.
    MixedModelEquations(std::span<const double> y, const FixedEffects& fixed, std::span<const RandomTerm> terms);

    CriterionParts criterionAt(std::span<const double> theta) const override { return factorised(theta); }
    SystemSolution solutionAt(std::span<const double> theta, bool reml) const override;

    Factorised factorised(std::span<const double> theta) const;
    /// The solution; every diagonal element of theta must be positive.
    Solved solved(const Factorised& factorised, bool withWeighted) const;

private:
    struct SparseRows {
        std::vector<std::size_t> starts{0};
        std::vector<std::uint32_t> columns;
        std::vector<double> values;
    };
    /// Lambda' applied to a matrix: row c becomes diagonal[c] row c + below[c] row c+1.
    struct Scaling {
        std::vector<double> diagonal;
        std::vector<double> below;
    };
    struct Columns {
        std::span<const double> y;
        const FixedEffects& fixed;
        std::span<const RandomTerm> terms;
    };
    struct Nonzero {
        std::size_t column;
        double value;
    };
    void place(std::span<const RandomTerm> terms);
    std::size_t nonzerosOf(std::size_t i, const Columns& data, std::vector<Nonzero>& row) const;
    void sumProducts(const Columns& data);
    Scaling scaling(std::span<const double> theta) const;
    Scaling inverseScaling(std::span<const double> theta) const;
    void scaleBorder(std::span<double> values, std::size_t level, const Scaling& scale) const;
    void eliminate(Factorised& result, const Scaling& scale) const;
    Matrix bordered(const Factorised& factorised, const Matrix& inverse) const;
    Matrix whitened(const Factorised& factorised, const Matrix& inverse, const Matrix& bordering) const;
    std::vector<double> scoreOf(const Factorised& factorised, std::span<const double> solution) const;
    void putFixedParts(Solved& result, const Factorised& factorised, const Matrix& inverse, const Matrix& bordering) const;

    std::size_t m_eliminated = 0;  ///< number of eliminated columns, which are the first
    std::size_t m_rest = 0;        ///< number of other random columns
    std::vector<double> m_counts;  ///< diagonal of the eliminated block
    SparseRows m_borders;          ///< products of the eliminated block with [rest, X, y]
    Matrix m_products;             ///< products of [rest, X, y] with itself, upper triangle
};

}  // namespace stats
