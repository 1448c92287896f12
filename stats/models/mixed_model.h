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

/// A weighted sum of the fixed effects against 0.
struct ContrastTest {
    Value estimate;
    Value se;
    Value df;  ///< Satterthwaite
    Value t;
    Value p;  ///< two-sided
    Value logP;
    Interval ci;
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

/// Weights: one a fixed effect, in their order.
ContrastTest contrastTest(const MixedModel& model, std::span<const double> weights, double confidence = 0.95);

/// Difference of two levels of a treatment-coded factor that is the only fixed effect: level a - level b,
/// level 0 being the reference.
ContrastTest levelDifference(const MixedModel& model, std::size_t a, std::size_t b, double confidence = 0.95);

struct FTest {
    std::string why;  ///< empty when the test exists
    Value f;
    Value df1;
    Value df2;
    Value p;
    Value logP;
};

/// All the fixed effects but the first (the intercept) against 0 together: the F test of condition. F
/// itself does not depend on how the hypothesis is written as contrasts; its denominator degrees of
/// freedom (from the eigenvectors of their covariance, Fai and Cornelius 1996) do where cells are missing.
/// As in lmerTest they are the sequential contrasts.
FTest effectTest(const MixedModel& model);

}  // namespace stats
