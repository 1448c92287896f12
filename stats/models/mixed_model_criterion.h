// Deviance or REML criterion of a linear mixed model, sigma profiled out, and its first two derivatives in theta. The
// fit minimises the criterion; Satterthwaite's degrees of freedom use the derivatives.
#pragma once

#include "stats/models/mixed_model_equations.h"

namespace stats {

/// The criterion: -2 log restricted likelihood (REML), otherwise -2 log likelihood; and the degrees of freedom of
/// sigma: rows minus fixed effects (REML), otherwise rows.
double profiledCriterion(const MixedModelEquations& equations, const Factorised& factorised, bool reml);
double residualDegrees(const MixedModelEquations& equations, bool reml);

/// Derivatives in the relative (co)variances gamma_k, V = sigma^2 (I + sum of gamma_k V_k). An intercept term has one
/// direction; a term with slope has three: variance of intercepts, covariance, variance of slopes.
struct VarianceDerivatives {
    std::vector<double> traces;           ///< tr(P V_k); tr(V^-1 V_k) without REML
    std::vector<double> forms;            ///< y'P V_k P y
    Matrix traceProducts;                 ///< tr(P V_k P V_l); tr(V^-1 V_k V^-1 V_l) without REML
    Matrix formProducts;                  ///< y'P V_k P V_l P y
    std::vector<Matrix> fixedCovariance;  ///< d C / d gamma_k
};
VarianceDerivatives varianceDerivatives(const MixedModelEquations& equations, const Solved& solved, bool reml);

/// Jacobian d gamma_l / d theta_k [theta x direction].
Matrix thetaJacobian(const MixedModelEquations& equations, std::span<const double> theta);

/// Hessian in theta of a function with the given gradient and Hessian in gamma.
Matrix thetaHessian(const MixedModelEquations& equations, std::span<const double> theta, std::span<const double> gradient,
                    const Matrix& hessian);

struct ThetaDerivatives {
    std::vector<double> gradient;
    Matrix hessian;
};
/// Gradient and Hessian of the profiled criterion in theta.
ThetaDerivatives profiledDerivatives(const MixedModelEquations& equations, const Factorised& factorised,
                                     const VarianceDerivatives& derivatives, bool reml);

}  // namespace stats
