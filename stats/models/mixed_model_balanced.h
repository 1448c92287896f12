// A balanced design: every term divides the rows into classes of one size, and the classes of any two terms cross or nest
// evenly, as in complete data. The covariance matrix then is a multiple of the identity on each of a few subspaces, the
// strata of the analysis of variance (Bailey 2008, Design of Comparative Experiments, ch. 10). Only their sums of squares
// enter the criterion, so a fit costs the same for any number of rows.
#pragma once

#include <optional>

#include "stats/models/mixed_model_rows.h"
#include "stats/models/mixed_model_system.h"

namespace stats {

struct Stratum {
    double squares = 0;             ///< sum of squares of y, after the fixed effects
    double degrees = 0;             ///< dimension
    bool fixed = false;             ///< true where the stratum belongs to the fixed effects
    std::vector<double> multiples;  ///< for each term: rows of a level where the stratum lies in its space, otherwise 0
};

struct BalancedDesign {
    std::size_t rows = 0;
    std::size_t conditions = 1;  ///< levels of the treatment-coded factor; 1: an intercept only
    std::vector<std::size_t> levels;
    std::vector<Stratum> strata;  ///< mean, condition (from two on), the terms in order of their levels, residual
};

/// The design of these rows; nothing where it is not balanced, where a term has slopes, or where the fixed effects are
/// not an intercept or a treatment-coded factor.
std::optional<BalancedDesign> balancedDesign(const MixedModelRows& data);

class BalancedEquations : public MixedModelSystem {
public:
    /// `kept`: the terms of the model; the others have no variance.
    BalancedEquations(const BalancedDesign& design, std::span<const std::size_t> kept);

    CriterionParts criterionAt(std::span<const double> theta) const override;
    SystemSolution solutionAt(std::span<const double> theta, bool reml) const override;

private:
    std::vector<double> multipliers(std::span<const double> theta) const;
    Matrix fixedCovariance(double ofMean, double ofCondition) const;
    VarianceDerivatives derivativesAt(std::span<const double> multipliers, bool reml) const;

    std::size_t m_conditions;
    std::vector<Stratum> m_strata;  ///< multiples of the kept terms only
};

}  // namespace stats
