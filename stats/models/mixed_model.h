// Linear mixed model: fixed effects (condition), and random intercepts and slopes of crossed or nested groups
// (participants, fabrics, their interactions with condition). A difference of conditions then holds for new
// participants and new fabrics, not only for those tested. Fitted by REML or maximum likelihood, with
// Satterthwaite's degrees of freedom. Cells may be missing: every row with a value is used.
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

/// Values, one in each row. NaN in y means missing; it is counted and left out. All columns have the length of y.
struct MixedModelData {
    std::vector<double> y;
    FixedEffects fixed;
    std::vector<RandomTerm> random;
};

struct MixedModelOptions {
    bool reml = true;  ///< restricted maximum likelihood; false: maximum likelihood
    double confidence = 0.95;
};

struct FixedEffect {
    std::string name;
    ContrastTest test;
};

/// Variances of a random term, in squared units of y; for slopes, of y per unit of the covariate.
struct RandomEffect {
    std::string name;  ///< name of the group
    Value variance;    ///< variance of the intercepts
    Value sd;
    std::string slopeName;  ///< empty where there are intercepts only; the rest is then undefined
    Value slopeVariance;
    Value slopeSd;
    Value correlation;
    bool zero = false;  ///< true where the estimate is zero, or a correlation 1
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
    bool singular = false;  ///< some variance was estimated as zero, or a correlation as 1; the tests
                            ///< are those of the model without that variance
    int steps = 0;          ///< Newton steps of the fit

    // For further tests; y is scaled by 2^-exponent here.
    int exponent = 0;
    std::vector<double> estimates;
    Matrix covariance;                          ///< covariance of the estimates
    std::vector<Matrix> covarianceDerivatives;  ///< its derivatives, one for each variance parameter
    Matrix parameterCovariance;                 ///< covariance of the variance parameters
    Matrix sequential;                          ///< row k: sequential (type I) contrast of fixed effect k
};

/// Fits the model. Refused with a reason: too few values, values that are not finite or all equal, linearly dependent
/// fixed effects, groups of one level or with a level for every row, no residual variation.
MixedModel fitMixedModel(const MixedModelData& data, const MixedModelOptions& options = {});

}  // namespace stats
