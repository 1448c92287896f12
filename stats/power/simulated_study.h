// Simulated studies, drawn from a stated model: an analysis can be tried on data whose truth is known.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "stats/kernels/block_table.h"
#include "stats/kernels/draws.h"
#include "stats/kernels/share.h"
#include "stats/models/crossed_study.h"

namespace stats {

/// A design in which every participant meets every fabric under every condition once.
struct StudyDesign {
    std::size_t participants = 10;
    std::size_t fabrics = 7;
    std::size_t conditions = 9;
    int alternatives = 3;  ///< alternatives of the forced choice

    std::size_t answers() const { return participants * fabrics * conditions; }
};

/// Rating = centre + mean of the condition + normal deviations with these variances (scale points squared). It is rounded to
/// the step of the scale and limited to its ends.
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

    /// SD of the difference between two conditions of a participant's mean over these fabrics.
    double sdOfDifference(const StudyDesign& design) const;
    /// Variance of a condition's mean, where participants and fabrics are both samples.
    double varianceOfMean(const StudyDesign& design) const;
};

/// Log odds of a right choice = log odds of the condition + normal deviations with these SDs.
struct ChoiceTruth {
    double participantSd = 0.5;
    double fabricSd = 0.4;
};

/// A study whose rows are ordered by participant, fabric and condition, and whose values are all NaN.
CrossedStudy emptyStudy(const StudyDesign& design);

/// Draws ratings. `means`: one for each condition, added to the centre.
void drawRatings(CrossedStudy& study, const RatingTruth& truth, std::span<const double> means, Draws& draws);

/// Draws choices. `logOdds`: one for each condition.
void drawChoices(CrossedStudy& study, const ChoiceTruth& truth, std::span<const double> logOdds, Draws& draws);

/// Means over the fabrics of a complete study [participants x conditions].
BlockTable participantMeans(const CrossedStudy& study);
/// Values of a complete study [participant x fabric blocks, conditions].
BlockTable answersByBlock(const CrossedStudy& study);

struct SimulationOptions {
    std::size_t studies = 10000;  ///< in all shares
    std::uint64_t seed = 1;
    unsigned threads = 0;  ///< 0: one for each core; changes no number
    double alpha = 0.05;
    std::function<void(std::size_t studies)> done = {};  ///< gets how many more are done; on one thread at a time
    Share share = {};                                    ///< the studies of this process; study i is the same whoever draws it

    std::size_t ownStudies() const { return share.sizeOf(studies); }
};

/// Rejections by one test in many simulated studies.
struct Rejections {
    std::size_t studies = 0;
    std::size_t rejected = 0;
    std::size_t undefined = 0;  ///< studies in which the test did not exist; counted as not rejected

    double rate() const;
    Interval interval() const;  ///< 95 % Wilson interval of the rate
};

/// Draws a study and stores the p of each test.
using SimulatedAnalysis = std::function<void(Draws& draws, std::span<Value> p)>;
std::vector<Rejections> simulateTests(std::size_t tests, const SimulatedAnalysis& analysis, const SimulationOptions& options);

}  // namespace stats
