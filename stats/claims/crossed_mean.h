// The mean of values of participants crossed with fabrics: a contrast of two conditions, or the answers under one. It is
// tested for two populations, because a mean over seven fabrics may hold for these fabrics only.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "stats/kernels/distributions.h"
#include "stats/kernels/value.h"
#include "stats/models/factor.h"
#include "stats/models/satterthwaite.h"
#include "stats/tests/t_tests.h"

namespace stats {

/// To whom and what a mean generalises.
enum class Generalisation {
    TheseFabrics,      ///< new participants, the same fabrics: participants vary
    FabricsLikeThese,  ///< new participants and new fabrics: both vary
};

/// Values, one in each row; NaN is missing. Several rows of one participant and fabric are repetitions.
struct CrossedValues {
    Factor participant;
    Factor fabric;
    std::vector<double> values;
};

/// One value of each participant and fabric, row-major [participants x fabrics]; NaN is missing.
struct CrossedTable {
    std::size_t participants = 0;
    std::size_t fabrics = 0;
    std::vector<double> values;
};

struct CrossedMean {
    std::string why;  ///< empty when the mean can be tested
    std::size_t values = 0;
    std::size_t participants = 0;
    std::size_t fabrics = 0;
    Value estimate;  ///< TheseFabrics: the mean of the participants' means; FabricsLikeThese: the estimate of the model
    Value se;
    Value df;
    Interval ci90;
    Interval ci95;
    bool singular = false;  ///< FabricsLikeThese: a variance was estimated as zero
};

/// Degrees of freedom of FabricsLikeThese where neither participants nor fabrics are estimated to vary.
enum class Degrees {
    Limited,        ///< Satterthwaite's, at most mostDegrees()
    Satterthwaite,  ///< where the rest of the study shows that nothing varies, too
};

/// TheseFabrics: Student's t on the participants' means over fabrics. FabricsLikeThese: linear mixed model with an intercept
/// and crossed random intercepts of participant and fabric, by REML. Its degrees of freedom are Satterthwaite's, at
/// most mostDegrees() where both variances are estimated as zero. A group with a level for every value is left out, as it is the
/// residual. Refused with a reason: fewer than two participants, fewer than two fabrics (FabricsLikeThese), values that are all
/// equal or not finite.
CrossedMean crossedMean(const CrossedValues& values, Generalisation generalisation);

/// The same for one of many tables. Complete tables have a closed form: the restricted estimates of the variances are those of
/// the analysis of variance, pooled where one would be negative (Thompson 1962, Ann. Math. Stat. 33(1), 273-289).
CrossedMean crossedMean(const CrossedTable& table, Generalisation generalisation, StudentQuantiles& quantiles,
                        Degrees degrees = Degrees::Limited);

/// A contrast of a mixed model with its intervals.
CrossedMean crossedMean(const ContrastTest& contrast);
CrossedMean crossedMean(const ContrastTest& contrast, StudentQuantiles& quantiles);

/// Upper limit of the degrees of freedom where neither participants nor fabrics are estimated to vary:
/// 1.2 / (rp^6 / (participants - 1) + rf^6 / (fabrics - 1)). rp and rf are the mean squares of participants and of fabrics,
/// divided by that of the residual. Satterthwaite's degrees then count the answers, although a mean square just below the
/// residual's is poor evidence that nothing varies. Far in the tails, where corrected tests decide, such tests reject too often:
/// with 7 fabrics of SD 0.5 and 10 participants 7.8 % of families of 36 contrasts, with this limit 5.6 %. Every participant and
/// fabric of the table has a value; mean squares of a table with gaps are approximate.
double mostDegrees(const CrossedTable& table);

/// t test of the mean.
struct MeanTest {
    Value t;
    Value p;
    Value logP;  ///< natural logarithm
};

MeanTest testOfMean(const CrossedMean& mean, double mu, Tail tail);

/// p of two one-sided tests against low < high: the larger of the two.
MeanTest equivalenceOfMean(const CrossedMean& mean, double low, double high);

}  // namespace stats
