// What the logistic and the ordinal mixed model have in common: their effects are log odds.
#pragma once

#include <string>

#include "stats/kernels/value.h"

namespace stats {

/// Log odds, or a difference of log odds from the reference.
struct LogOdds {
    std::string name;  ///< "(Intercept)", "conditionf"
    Value estimate;
    Value se;
    Value z;
    Value p;  ///< Wald test, two-sided
    Value logP;
    Interval ci;
};

struct RandomIntercept {
    std::string name;
    Value sd;  ///< log odds
    bool zero = false;
};

/// The conditions that predict their answers perfectly, so that their log odds are infinite.
enum class Separation {
    None,
    Quasi,     ///< some conditions
    Complete,  ///< all of them: condition predicts every answer
};

/// Likelihood-ratio test of a model against the one without condition.
struct LikelihoodRatio {
    Value chiSquared;
    Value df;
    Value p;
    Value logP;
};

/// An estimate with its Wald test and interval.
LogOdds logOddsOf(const std::string& name, double estimate, double variance, double confidence);

LogOdds undefinedLogOdds(const std::string& name, const std::string& why);

/// Test from two values of -2 log likelihood.
LikelihoodRatio likelihoodRatioOf(double criterion, double criterionNull, std::size_t df);

}  // namespace stats
