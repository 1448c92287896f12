// Deviance or REML criterion of a linear mixed model, sigma profiled out, and its first two derivatives in theta. The
// fit minimises the criterion; Satterthwaite's degrees of freedom use the derivatives.
#pragma once

#include "stats/models/mixed_model_equations.h"
#include "stats/models/mixed_model_system.h"

namespace stats {

/// The criterion: -2 log restricted likelihood (REML), otherwise -2 log likelihood; and the degrees of freedom of
/// sigma: rows minus fixed effects (REML), otherwise rows.
double profiledCriterion(const MixedModelSystem& system, const CriterionParts& parts, bool reml);
double residualDegrees(const MixedModelSystem& system, bool reml);

/// Derivatives of the criterion from the dense matrix Z'PZ.
VarianceDerivatives varianceDerivatives(const MixedModelEquations& equations, const Solved& solved, bool reml);

/// Jacobian d gamma_l / d theta_k [theta x direction].
Matrix thetaJacobian(const MixedModelSystem& system, std::span<const double> theta);

/// Hessian in theta of a function with the given gradient and Hessian in gamma.
Matrix thetaHessian(const MixedModelSystem& system, std::span<const double> theta, std::span<const double> gradient,
                    const Matrix& hessian);

struct ThetaDerivatives {
    std::vector<double> gradient;
    Matrix hessian;
};
/// Gradient and Hessian of the profiled criterion in theta.
ThetaDerivatives profiledDerivatives(const MixedModelSystem& system, const CriterionParts& parts,
                                     const VarianceDerivatives& derivatives, bool reml);

}  // namespace stats
