// Logistic mixed model of right and wrong choices: one probability a condition, random intercepts of
// crossed groups (participants and fabrics), fitted by Laplace's approximation with all parameters
// together, and the likelihood-ratio test of condition against the model without it.
//
// Where a condition was answered always rightly or always wrongly the likelihood has no maximum: its log
// odds run off to infinity (separation). That is said instead of a number; the rest is still fitted.
#pragma once

#include <string>
#include <vector>

#include "stats/kernels/matrix.h"
#include "stats/kernels/value.h"
#include "stats/models/factor.h"

namespace stats {

/// One row a choice: 1 right, 0 wrong, NaN missing (counted and left out). The first level of condition
/// that has choices is the reference.
struct LogisticData {
    std::vector<double> right;
    Factor condition;
    std::vector<Factor> groups;
};

enum class Separation {
    None,
    Quasi,     ///< some conditions were always or never right
    Complete,  ///< all of them: condition predicts every choice
};

/// Log odds, or a difference of log odds from the reference.
struct LogOdds {
    std::string name;  ///< "(Intercept)", "conditionf"
    Value estimate;
    Value se;
    Value z;
    Value p;  ///< Wald, two-sided
    Value logP;
    Interval ci;
};

struct RandomIntercept {
    std::string name;
    Value sd;  ///< log odds
    bool zero = false;
};

struct LogisticMixedModel {
    std::string why;  ///< empty when the model was fitted
    std::size_t rows = 0;
    std::size_t missing = 0;
    Separation separation = Separation::None;
    std::string separationWhy;  ///< names the conditions
    std::vector<LogOdds> fixed;
    std::vector<RandomIntercept> random;
    bool singular = false;  ///< a standard deviation was estimated as zero
    Value logLikelihood;    ///< Laplace; its supremum where there is separation
    Value logLikelihoodNull;
    Value chiSquared;  ///< likelihood-ratio test of condition
    Value df;
    Value p;
    Value logP;
    Matrix covariance;  ///< of the estimates; empty where there is separation
    int evaluations = 0;
};

/// Refused with a reason: no choices, all right or all wrong, a value that is neither, one condition,
/// groups of one level.
LogisticMixedModel fitLogisticMixedModel(const LogisticData& data, double confidence = 0.95);

}  // namespace stats
