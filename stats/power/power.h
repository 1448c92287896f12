// Power by formula: the probability that a planned test rejects when the truth is as stated. For the power of the same
// tests in simulated studies see power_plan.h.
#pragma once

#include <cstddef>
#include <functional>

#include "stats/kernels/value.h"
#include "stats/power/simulated_study.h"

namespace stats {

/// Power of the two-sided t test of n >= 2 differences (or values), from the noncentral t distribution. Their mean lies
/// `effect` standard deviations from the hypothesis.
double tTestPower(double n, double effect, double alpha = 0.05);

/// Two one-sided tests of n >= 2 differences, sd > 0, low < high. Their power is the probability that the 1 - 2 alpha
/// interval lies inside the bounds, integrated over the distribution of the standard error.
struct EquivalencePlan {
    double n = 10;
    double sd = 1;  ///< SD of the differences
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

    long long critical() const;  ///< smallest count that is rejected; trials + 1: none is
    double size() const;         ///< probability of a rejection at chance, at most alpha
};
double binomialPower(const BinomialPlan& plan, double probability);

// Power of the tests of all conditions together. `spread` is the sum of squared deviations of the conditions' means
// from their mean.

/// F test on participant means (repeated measures) with spherical errors.
double repeatedMeasuresPower(const StudyDesign& design, const RatingTruth& truth, double spread, double alpha = 0.05);
/// Friedman's test, from its efficiency 3 k / (pi (k + 1)) relative to that F for many participants and normal ratings.
double friedmanPower(const StudyDesign& design, const RatingTruth& truth, double spread, double alpha = 0.05);
/// F test of the mixed model, in which fabrics and participants are both samples; degrees of freedom of balanced data.
double ratingModelPower(const StudyDesign& design, const RatingTruth& truth, double spread, double alpha = 0.05);
/// t test of one difference of two conditions in that model, with the same degrees of freedom.
double ratingDifferencePower(const StudyDesign& design, const RatingTruth& truth, double difference, double alpha = 0.05);
/// Likelihood-ratio test of choices for large samples; `spread` in log odds about an overall probability.
double choiceModelPower(const StudyDesign& design, double probability, double spread, double alpha = 0.05);

/// Means of k conditions, evenly spaced from -range/2 to range/2, and their sum of squares.
std::vector<double> evenlySpaced(std::size_t conditions, double range);
double sumOfSquares(std::span<const double> deviations);

/// Smallest effect between 0 and `most` with the power wanted; the power must increase with the effect.
Value smallestDetectable(const std::function<double(double)>& power, double most, double wanted = 0.8);

/// Smallest number of participants from 2 to `most` with the power wanted.
Value participantsNeeded(const std::function<double(double)>& power, std::size_t most = 1000, double wanted = 0.8);

}  // namespace stats
