// Minimises the criterion of a linear mixed model over theta: Newton's method with exact second derivatives; every
// step must lower the criterion. Deterministic.
#pragma once

#include <string>

#include "stats/models/mixed_model_criterion.h"

namespace stats {

/// Lower bound of a relative standard deviation; an estimate at the bound counts as zero.
inline constexpr double thetaFloor = 1e-4;
/// Beyond this relative standard deviation no residual variation is left, which is the reason of a refusal.
inline constexpr double largestTheta = 1e5;
inline constexpr const char* noResidual = "the random effects reproduce every value: no residual variation is left";

struct ThetaFit {
    std::string why;  ///< empty when a minimum was found
    CriterionParts parts;
    SystemSolution solution;
    std::vector<bool> free;  ///< for each theta: not at the lower bound
    int steps = 0;
};

ThetaFit fitTheta(const MixedModelSystem& system, bool reml);

}  // namespace stats
