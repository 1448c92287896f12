// Finds the theta at which a linear mixed model's criterion is least: Newton's method with exact second
// derivatives, steps kept downhill. Deterministic.
#pragma once

#include <string>

#include "stats/models/mixed_model_criterion.h"

namespace stats {

/// Relative standard deviations are kept above this; one that ends here is zero.
inline constexpr double thetaFloor = 1e-4;

struct ThetaFit {
    std::string why;  ///< empty when a minimum was found
    Factorised factorised;
    Solved solved;
    VarianceDerivatives derivatives;
    std::vector<bool> free;  ///< by theta: not held at the floor
    int steps = 0;
};

ThetaFit fitTheta(const MixedModelEquations& equations, bool reml);

}  // namespace stats
