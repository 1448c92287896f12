// Psychometric function of an m-alternative forced choice: how the probability of a correct choice rises with the level of
// the stimulus. P(x) = 1/m + (1 - 1/m - lapse) Phi((x - mu) / sigma), by maximum likelihood (Wichmann and Hill 2001).
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "stats/kernels/value.h"

namespace stats {

/// Choices at one level of the stimulus.
struct LevelCounts {
    double level = 0;
    double correct = 0;  ///< 0 to trials
    double trials = 0;   ///< above 0
};

/// Share of choices that are wrong at any level, by a slip.
struct LapseRate {
    bool estimated = false;
    double fixed = 0;   ///< where it is not estimated, 0 to `most`
    double most = 0.1;  ///< upper limit of the estimate
};

struct PsychometricOptions {
    int alternatives = 3;  ///< at least 2; 1/alternatives is chance
    LapseRate lapse;
    std::optional<double> thresholdAt;  ///< probability correct at the threshold; else half way, where the threshold is mu
    double confidence = 0.95;
};

/// An estimate with the standard error from Fisher's information and two intervals.
struct PsychometricEstimate {
    Value estimate;
    Value se;
    Interval wald;
    Interval profile;  ///< from the likelihood ratio; infinite where the data set no limit
};

struct PsychometricFit {
    std::string why;         ///< empty when the function was fitted
    std::size_t levels = 0;  ///< different levels
    double trials = 0;
    PsychometricEstimate mu;     ///< unit of the levels
    PsychometricEstimate sigma;  ///< unit of the levels
    PsychometricEstimate threshold;
    Value lapse;
    Value seLapse;                    ///< undefined where the rate is fixed or at a limit
    bool lapseAtLimit = false;        ///< estimated as 0 or as the largest rate allowed
    Value logLikelihood;              ///< with the binomial coefficients, as logLik() of R's glm
    Value deviance;                   ///< 2 (log likelihood of one share for each level - log likelihood)
    Value df;                         ///< levels - parameters
    Value p;                          ///< chi-squared test of the deviance; undefined without degrees of freedom
    std::vector<LevelCounts> counts;  ///< one for each level, ascending
    std::vector<double> fitted;       ///< probability of a correct choice at each of these levels
};

/// Fits the function. Rows of one level are added up. Refused with a reason: no trials, counts that are impossible, one level,
/// all choices correct or all wrong. Refused as well are shares that stay at chance, that do not rise with the level, or that
/// rise in one step, where the likelihood has no maximum.
PsychometricFit fitPsychometricFunction(std::span<const LevelCounts> counts, const PsychometricOptions& options = {});

}  // namespace stats
