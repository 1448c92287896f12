// Logistic mixed model of right and wrong choices: one probability for each condition and random intercepts of
// crossed groups (participants and fabrics), fitted by Laplace's approximation in all parameters together. The
// likelihood-ratio test compares it with the model without condition.
//
// Where all choices of a condition are right, or all wrong, the likelihood has no maximum: the log odds become
// infinite (separation). The result then names the condition instead of a number; the rest is still fitted.
#pragma once

#include <string>
#include <vector>

#include "stats/kernels/matrix.h"
#include "stats/kernels/value.h"
#include "stats/models/factor.h"
#include "stats/models/laplace_fit.h"
#include "stats/models/log_odds.h"

namespace stats {

/// Choices, one in each row: 1 right, 0 wrong, NaN missing (counted and left out). The first level of condition that
/// has choices is the reference.
struct LogisticData {
    std::vector<double> right;
    Factor condition;
    std::vector<Factor> groups;
};

struct LogisticOptions {
    double confidence = 0.95;
    Curvature curvature = Curvature::AtOneStep;
};

struct LogisticMixedModel {
    std::string why;  ///< empty when the model was fitted
    std::size_t rows = 0;
    std::size_t missing = 0;
    Separation separation = Separation::None;
    std::string separationWhy;  ///< names the separated conditions
    std::vector<LogOdds> fixed;
    std::vector<RandomIntercept> random;
    bool singular = false;  ///< a standard deviation was estimated as zero
    Value logLikelihood;    ///< Laplace's approximation; its supremum where there is separation
    Value logLikelihoodNull;
    Value chiSquared;  ///< likelihood-ratio test of condition
    Value df;
    Value p;
    Value logP;
    Matrix covariance;  ///< covariance of the estimates; empty where there is separation
    int evaluations = 0;
};

/// Fits the model. Refused with a reason: no choices, all right or all wrong, a value that is neither, one condition,
/// groups of one level.
LogisticMixedModel fitLogisticMixedModel(const LogisticData& data, const LogisticOptions& options = {});

}  // namespace stats
