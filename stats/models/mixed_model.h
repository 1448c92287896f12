// Linear mixed model: fixed effects (condition) beside random intercepts, and slopes of one covariate,
// of any crossed or nested groups (participants, fabrics, their interactions with condition), so that a
// difference of conditions holds for new participants and new fabrics, not only for those tested.
// REML or maximum likelihood; Satterthwaite's degrees of freedom (Kuznetsova et al. 2017, J. Stat.
// Softw. 82(13)). Missing cells need no care: every row there is counts.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "stats/kernels/matrix.h"
#include "stats/kernels/value.h"
#include "stats/models/factor.h"
#include "stats/models/mixed_model_equations.h"
#include "stats/models/satterthwaite.h"

namespace stats {

/// One row a value; NaN in y means missing and is counted and left out. All columns of y's length.
struct MixedModelData {
    std::vector<double> y;
    FixedEffects fixed;
    std::vector<RandomTerm> random;
};

struct MixedModelOptions {
    bool reml = true;  ///< false: maximum likelihood
    double confidence = 0.95;
};

struct FixedEffect {
    std::string name;
    ContrastTest test;
};

/// Variances in squared units of y (of y per unit of the covariate for slopes).
struct RandomEffect {
    std::string name;  ///< of the group
    Value variance;    ///< of the intercepts
    Value sd;
    std::string slopeName;  ///< empty for intercepts alone: then the rest is undefined
    Value slopeVariance;
    Value slopeSd;
    Value correlation;
    bool zero = false;  ///< the estimate lies on the boundary
};

struct MixedModel {
    std::string why;  ///< empty when the model was fitted
    std::size_t rows = 0;
    std::size_t missing = 0;
    std::vector<FixedEffect> fixed;
    std::vector<RandomEffect> random;
    Value residualVariance;
    Value residualSd;
    Value criterion;        ///< -2 log restricted likelihood (the "REML criterion"), or -2 log likelihood
    bool singular = false;  ///< some random effect was estimated as zero, or a correlation as 1: the tests
                            ///< are those of the model without it
    int steps = 0;          ///< of the fit

    // What further tests need; y is scaled by 2^-exponent here.
    int exponent = 0;
    std::vector<double> estimates;
    Matrix covariance;                          ///< of the estimates
    std::vector<Matrix> covarianceDerivatives;  ///< by variance parameter
    Matrix parameterCovariance;                 ///< of the variance parameters
    Matrix sequential;                          ///< row k: the contrast that fixed effect k adds to those before it (type I)
};

/// Refused with a reason: too few values, values that are not finite, all equal, fixed effects that
/// determine each other, groups of one level or with a level for every row, nothing left for the residual.
MixedModel fitMixedModel(const MixedModelData& data, const MixedModelOptions& options = {});

}  // namespace stats
