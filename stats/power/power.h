// Power by formula: the probability that a planned test rejects when the truth is as stated. What the
// same tests do on simulated studies: power_plan.h.
#pragma once

#include <cstddef>
#include <functional>

#include "stats/kernels/value.h"
#include "stats/power/simulated_study.h"

namespace stats {

/// Two-sided t test of n differences (or values) whose mean lies `effect` standard deviations from the
/// hypothesis: noncentral t. n >= 2.
double tTestPower(double n, double effect, double alpha = 0.05);

/// Two one-sided tests of n differences: the chance that the 1 - 2 alpha interval lies inside the bounds.
/// Exact: over the distribution of the standard error. n >= 2, sd > 0, low < high.
struct EquivalencePlan {
    double n = 10;
    double sd = 1;  ///< of the differences
    double low = -0.5;
    double high = 0.5;
    double alpha = 0.05;
};
double equivalencePower(const EquivalencePlan& plan, double trueDifference);

/// One-sided exact binomial test of more successes than by chance.
struct BinomialPlan {
    long long trials = 70;
    double chance = 1.0 / 3;
    double alpha = 0.05;

    long long critical() const;  ///< rejects from this count on; trials + 1: never
    double size() const;         ///< attained at chance, at most alpha
};
double binomialPower(const BinomialPlan& plan, double probability);

/// What differs between conditions, for the tests of all of them together: `spread` is the sum of squared
/// deviations of the conditions' means from their mean.
/// F test on participant means (repeated measures), the conditions' errors being spherical.
double repeatedMeasuresPower(const StudyDesign& design, const RatingTruth& truth, double spread, double alpha = 0.05);
/// Friedman's test: its efficiency relative to that F with many participants and normal ratings,
/// 3 k / (pi (k + 1)).
double friedmanPower(const StudyDesign& design, const RatingTruth& truth, double spread, double alpha = 0.05);
/// F test of the mixed model, fabrics and participants both sampled; degrees of freedom as balanced data
/// give them.
double ratingModelPower(const StudyDesign& design, const RatingTruth& truth, double spread, double alpha = 0.05);
/// t test of one difference of two conditions in that model, by the same degrees of freedom.
double ratingDifferencePower(const StudyDesign& design, const RatingTruth& truth, double difference, double alpha = 0.05);
/// Likelihood-ratio test of choices (large samples); `spread` in log odds, about an overall probability.
double choiceModelPower(const StudyDesign& design, double probability, double spread, double alpha = 0.05);

/// Means of k conditions, evenly spaced from -range/2 to range/2, and their sum of squares.
std::vector<double> evenlySpaced(std::size_t conditions, double range);
double sumOfSquares(std::span<const double> deviations);

/// Smallest effect between 0 and `most` with the power wanted, for a power that rises with the effect.
Value smallestDetectable(const std::function<double(double)>& power, double most, double wanted = 0.8);

/// Smallest n from 2 to `most` with the power wanted.
Value participantsNeeded(const std::function<double(double)>& power, std::size_t most = 1000, double wanted = 0.8);

}  // namespace stats
