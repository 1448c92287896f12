// Cumulative logit mixed model of ratings in ordered categories, with crossed random intercepts, fitted by Laplace's
// approximation in all parameters together:
//
//     P(rating <= j) = F(threshold_j - effect of the condition - random intercepts),  F(x) = 1 / (1 + exp(-x)).
//
// The first condition has the effect 0. There is one threshold between neighbouring values that occur. With two values the
// model is the logistic one. Standard errors come from the curvature of the likelihood (as in ordinal::clmm).
//
// Where all ratings of a condition are the lowest value, or all the highest, its effect is infinite (separation). The result
// then names the condition instead of a number; the rest is still fitted.
#pragma once

#include <string>
#include <vector>

#include "stats/kernels/value.h"
#include "stats/models/factor.h"
#include "stats/models/log_odds.h"

namespace stats {

/// Ratings, one in each row; NaN is missing (counted and left out). Each different value is a category. The first level of
/// condition that has ratings is the reference.
struct OrdinalData {
    std::vector<double> values;
    Factor condition;
    std::vector<Factor> groups;
};

struct OrdinalOptions {
    double confidence = 0.95;
    bool likelihoodRatio = false;  ///< tests condition, which takes a second fit
};

/// Log odds of a rating at or below `below` under the reference condition.
struct Threshold {
    double below = 0;
    double above = 0;
    Value estimate;
    Value se;
};

/// More different values are refused.
inline constexpr std::size_t mostOrdinalCategories = 101;

struct OrdinalMixedModel {
    std::string why;  ///< empty when the model was fitted
    std::size_t rows = 0;
    std::size_t missing = 0;
    std::vector<double> levels;       ///< values that occur, ascending
    std::vector<std::size_t> counts;  ///< ratings of each
    Separation separation = Separation::None;
    std::string separationWhy;   ///< names the separated conditions
    std::vector<LogOdds> fixed;  ///< conditions after the first: log odds ratio of a higher rating
    std::vector<Threshold> thresholds;
    std::vector<RandomIntercept> random;
    bool singular = false;  ///< a standard deviation was estimated as zero
    Value logLikelihood;    ///< Laplace's approximation; its supremum where there is separation
    Value logLikelihoodNull;
    LikelihoodRatio test;  ///< of condition, where it was asked for
    int evaluations = 0;
};

/// Fits the model. Refused with a reason: no ratings, all alike, one condition, groups of one level, too many values,
/// conditions whose ranges of ratings do not overlap.
OrdinalMixedModel fitOrdinalMixedModel(const OrdinalData& data, const OrdinalOptions& options = {});

}  // namespace stats
