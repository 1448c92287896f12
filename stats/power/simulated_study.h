// Studies drawn from a stated model, so that an analysis can be tried on data whose truth is known.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "stats/kernels/block_table.h"
#include "stats/kernels/draws.h"
#include "stats/models/crossed_study.h"

namespace stats {

/// Every participant meets every fabric under every condition once.
struct StudyDesign {
    std::size_t participants = 10;
    std::size_t fabrics = 7;
    std::size_t conditions = 9;
    int alternatives = 3;  ///< of the forced choice

    std::size_t answers() const { return participants * fabrics * conditions; }
};

/// Rating = centre + mean of the condition + normal deviations of these variances, scale points squared,
/// rounded to the step of the scale and kept on it.
struct RatingTruth {
    double centre = 5.5;
    double participant = 0.5;
    double fabric = 0.2;
    double participantCondition = 0.15;
    double fabricCondition = 0.05;
    double residual = 0.85;
    double scaleMin = 0;
    double scaleMax = 10;
    double scaleStep = 0.1;

    /// SD of the difference of a participant's means under two conditions, over these fabrics.
    double sdOfDifference(const StudyDesign& design) const;
    /// Variance of a condition's mean about its expectation, participants and fabrics both drawn anew.
    double varianceOfMean(const StudyDesign& design) const;
};

/// Log odds of a right choice = those of the condition + normal deviations of these SDs.
struct ChoiceTruth {
    double participantSd = 0.5;
    double fabricSd = 0.4;
};

/// Rows ordered by participant, fabric, condition; all values NaN.
CrossedStudy emptyStudy(const StudyDesign& design);

/// `means`: one a condition, added to the centre.
void drawRatings(CrossedStudy& study, const RatingTruth& truth, std::span<const double> means, Draws& draws);

/// `logOdds`: one a condition.
void drawChoices(CrossedStudy& study, const ChoiceTruth& truth, std::span<const double> logOdds, Draws& draws);

/// Means over fabrics of a study without gaps [participants x conditions].
BlockTable participantMeans(const CrossedStudy& study);
/// [participant x fabric blocks, conditions].
BlockTable answersByBlock(const CrossedStudy& study);

struct SimulationOptions {
    std::size_t studies = 10000;
    std::uint64_t seed = 1;
    unsigned threads = 0;  ///< 0: as many as the machine has; changes no number
    double alpha = 0.05;
    std::function<void(std::size_t studies)> done = {};  ///< gets how many more are done; on one thread at a time
};

/// Of one test over many simulated studies.
struct Rejections {
    std::size_t studies = 0;
    std::size_t rejected = 0;
    std::size_t undefined = 0;  ///< the test did not exist; counted as not rejected

    double rate() const;
    Interval interval() const;  ///< of the rate, 95 %, Wilson
};

/// Draws a study and puts the p values of some tests of it in their places.
using StudyAnalysis = std::function<void(Draws& draws, std::span<Value> p)>;
std::vector<Rejections> simulateTests(std::size_t tests, const StudyAnalysis& analysis, const SimulationOptions& options);

}  // namespace stats
