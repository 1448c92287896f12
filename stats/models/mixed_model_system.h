// What the fit of a linear mixed model needs of its data: the parts of the criterion and its derivatives at any theta, the
// relative covariance parameters (Bates et al. 2015, J. Stat. Softw. 67(1)). V = sigma^2 (Z Lambda Lambda' Z' + I).
// There are three kinds: balanced data in closed form, blocks of one factor, and any data with a dense matrix.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "stats/kernels/matrix.h"

namespace stats {

/// Position of a term among the random columns (level by level) and in theta. An intercept has the theta (sd), an
/// intercept with slope the lower triangular factor (l00, l10, l11).
struct TermPlace {
    std::size_t components = 1;
    std::size_t levels = 0;
    std::size_t firstColumn = 0;
    std::size_t firstTheta = 0;
};

/// Parts of the criterion for one theta.
struct CriterionParts {
    bool exists = false;      ///< false where the matrix is singular up to rounding
    double logDetRandom = 0;  ///< log |Lambda'Z'Z Lambda + I|
    double logDetFixed = 0;   ///< log |X'V^-1 X|, sigma = 1
    double residual = 0;      ///< y'Py, sigma = 1: the penalised residual sum of squares
    std::vector<double> theta;
};

/// Derivatives in the relative (co)variances gamma_k, V = sigma^2 (I + sum of gamma_k V_k). An intercept term has one
/// direction; a term with slope has three: variance of intercepts, covariance, variance of slopes.
struct VarianceDerivatives {
    std::vector<double> traces;           ///< tr(P V_k); tr(V^-1 V_k) without REML
    std::vector<double> forms;            ///< y'P V_k P y
    Matrix traceProducts;                 ///< tr(P V_k P V_l); tr(V^-1 V_k V^-1 V_l) without REML
    Matrix formProducts;                  ///< y'P V_k P V_l P y
    std::vector<Matrix> fixedCovariance;  ///< d C / d gamma_k
};

/// Solution for one theta, sigma = 1. P = V^-1 - V^-1 X (X'V^-1 X)^-1 X'V^-1.
struct SystemSolution {
    std::vector<double> fixed;  ///< estimates
    Matrix fixedCovariance;     ///< C = (X'V^-1 X)^-1
    VarianceDerivatives derivatives;
};

class MixedModelSystem {
public:
    MixedModelSystem(std::size_t rows, std::size_t fixed) : m_rows(rows), m_fixed(fixed) {}
    virtual ~MixedModelSystem() = default;

    const std::vector<TermPlace>& terms() const { return m_terms; }
    std::size_t rows() const { return m_rows; }
    std::size_t fixedCount() const { return m_fixed; }
    std::size_t thetaCount() const;

    virtual CriterionParts criterionAt(std::span<const double> theta) const = 0;
    /// Every diagonal element of theta must be positive.
    virtual SystemSolution solutionAt(std::span<const double> theta, bool reml) const = 0;

protected:
    std::size_t m_rows = 0;
    std::size_t m_fixed = 0;
    std::vector<TermPlace> m_terms;
};

}  // namespace stats
