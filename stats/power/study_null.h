// Studies that are like a given one but have no true difference: the same answers are present, the same contrasts are tested, and
// answers vary as they were estimated to vary. How often does such a study claim something falsely?
#pragma once

#include <optional>
#include <vector>

#include "stats/claims/claims.h"
#include "stats/power/simulated_study.h"

namespace stats {

/// SDs of the random effects: scale points (ratings) or log odds (choices). Fabrics and participants are drawn anew for each
/// study.
struct StudyNull {
    double centre = 5;  ///< mean rating, or share of right choices
    double lowest = 0;  ///< ends of the scale; ratings are limited to them
    double highest = 10;
    double participantSd = 0;
    double fabricSd = 0;
    double participantConditionSd = 0;
    double fabricConditionSd = 0;
    double residualSd = 1;                             ///< ratings only
    AnswerCube asked{AnswerValues::Ratings, 0, 0, 0};  ///< cells without a value stay missing
    std::vector<ContrastPair> contrasts;
};

/// False claims for fabrics like these.
struct FalseClaims {
    Rejections first;  ///< the first contrast of the family, without a correction
    Rejections any;    ///< any contrast of the family, after the correction
};

/// Draws options.studies studies. Needs a contrast, two participants and two fabrics.
FalseClaims simulateStudyNull(const StudyNull& null, const SimulationOptions& options);

}  // namespace stats
