// Studies that are like a given one but have no true difference: the same answers are present, the same contrasts are tested, and
// answers vary as they were estimated to vary. How often does such a study claim something falsely?
#pragma once

#include <optional>
#include <vector>

#include "stats/claims/claims.h"
#include "stats/power/simulated_study.h"

namespace stats {

/// One answer of a study: its cell.
struct AskedAnswer {
    std::size_t condition = 0, participant = 0, fabric = 0;
    bool operator==(const AskedAnswer&) const = default;
};

/// Answers of a cell that a comparison takes, by unit; units count equally. The numbers are places in StudyNull::answers.
struct ComparedCell {
    std::size_t participant = 0, fabric = 0;
    std::vector<std::vector<std::size_t>> units;
};

/// Two conditions, compared on the answers that have a partner under the other one.
struct ComparedConditions {
    ContrastPair contrast;
    std::vector<ComparedCell> ofA, ofB;
};

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
    double residualSd = 1;                             ///< ratings only: of a cell
    double answerSd = 0;                               ///< ratings only: of the answers of a cell about what the cell has
    AnswerCube asked{AnswerValues::Ratings, 0, 0, 0};  ///< cells without a value stay missing
    /// Every answer, by condition, where cells have several; those of a cell side by side. Empty: one answer in each cell that
    /// `asked` has.
    std::vector<AskedAnswer> answers;
    std::vector<ComparedConditions> compared;  ///< by contrast, where cells have several answers
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
