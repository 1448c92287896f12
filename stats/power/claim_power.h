// Power by formula of the claims that a report makes: contrasts of two conditions, and choices above chance. Each for these
// fabrics and for fabrics like these, for complete data.
#pragma once

#include "stats/claims/crossed_mean.h"
#include "stats/power/simulated_study.h"

namespace stats {

/// Variances of values of participants crossed with fabrics, squared units of the values.
struct CrossedVariances {
    double participant = 0;
    double fabric = 0;
    double residual = 1;
};

/// Variances of the difference of the ratings under two conditions.
CrossedVariances ofDifference(const RatingTruth& truth);

/// Variances of choices that count as 0 and 1, `probability` of them right; to first order in the SDs of the log odds.
CrossedVariances ofChoices(const ChoiceTruth& truth, double probability);

/// Variances of the difference of such choices under two conditions. They have no interactions with condition.
CrossedVariances ofDifference(const ChoiceTruth& truth, double probabilityA, double probabilityB);

/// The standard error that is expected for the mean of all values, and the degrees of freedom of its t test.
struct ExpectedError {
    double se = 1;
    double df = 1;
};

/// TheseFabrics: participants - 1 degrees of freedom. FabricsLikeThese: Satterthwaite's, from the expected mean squares of
/// balanced data. At least 2 participants; FabricsLikeThese: at least 2 fabrics.
ExpectedError expectedError(const StudyDesign& design, const CrossedVariances& variances, Generalisation generalisation);

/// Two-sided t test of a mean that is `difference` from the hypothesis; noncentral t distribution.
double differencePower(const ExpectedError& error, double difference, double alpha);

/// One-sided t test of a mean that is `excess` above the hypothesis.
double abovePower(const ExpectedError& error, double excess, double alpha);

/// Two one-sided tests at low < high, for a true difference.
double boundsPower(const ExpectedError& error, double low, double high, double trueDifference, double alpha);

/// The narrowest bounds about 0 within which a true difference of 0 is shown equivalent with a power of 80 %. Undefined where
/// bounds of `most` do not suffice.
Value narrowestBounds(const ExpectedError& error, double most, double alpha);

}  // namespace stats
