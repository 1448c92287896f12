// The answers to anchors, question by question: the floor that mismatched presentations show, and the noise and the ceiling that
// repeated ones show. The analysis of conditions never uses them.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "reports/cells/answer_cells.h"
#include "reports/data/study_data.h"
#include "stats/kernels/value.h"
#include "stats/tests/reliability.h"

namespace reports {

/// Ratings of the image of one fabric with another fabric on the tray.
struct AnchorFloor {
    std::vector<std::string> conditions;  ///< of the images, in the order of their names
    std::size_t ratings = 0;
    std::size_t participants = 0;
    stats::Value mean;                  ///< over ratings, as for a condition
    stats::Value sd;                    ///< over ratings
    stats::Value meanOfParticipants;    ///< mean of the participants' means
    stats::Interval ci95;               ///< its interval, Student's t
    std::string lowest;                 ///< the condition with the lowest mean
    stats::Value lowestMean;            ///< over its ratings
    stats::Value shareAbove;            ///< share of these ratings that lie above `lowestMean`
    std::vector<std::string> notAbove;  ///< conditions whose mean is not above the floor's
};

struct QuestionAnchors {
    std::string question;
    std::optional<AnchorFloor> floor = {};                 ///< of a rating with mismatched presentations
    std::optional<stats::RatingReliability> ratings = {};  ///< of a rating with repeated presentations
    std::optional<stats::ChoiceReliability> choices = {};  ///< of a choice with repeated presentations
    std::string noPairs = {};                              ///< why there are none, although answers came twice; else empty
    stats::ChoicesCompared compared = {};                  ///< comparedBy()
    int alternatives = 0;                                  ///< of `choices`
};

/// The first and the second answer to one presentation, in the order of time. A presentation that was voided comes again later,
/// so that of the list may be the second.
using AnswersTwice = std::pair<const StudyResponse*, const StudyResponse*>;

/// The pairs of each participant. Where one of the two presentations has no answer that counts there is no pair. A second answer
/// of another session or repetition belongs to the first one where the participant has one of each for the presentation.
std::map<std::string, std::vector<AnswersTwice>> answersTwice(const StudyData& data, const std::string& question);

/// Whether two answers to this question agree where both are right or both are wrong: its choices came again beside other foils,
/// so that the fabrics that were chosen cannot be compared. Elsewhere the same answer agrees, also where another question of the
/// study has other foils.
bool agreesByOutcome(const StudyData& data, const QuestionInfo& question);

/// What the choices of this question that came twice are compared by.
stats::ChoicesCompared comparedBy(const StudyData& data, const QuestionInfo& question);

/// One entry for each question with answers to anchors, in the order of the study; also where they cannot be compared.
std::vector<QuestionAnchors> anchorsOf(const StudyData& data, const AnswerCells& cells);

/// The entry of this question; null without one.
const QuestionAnchors* anchorsOf(const std::vector<QuestionAnchors>& anchors, const std::string& question);

/// The ceiling of the mean rating, or of the share of right answers; null where nothing is compared.
const stats::Estimate* ceilingOf(const QuestionAnchors& anchors);
/// ICC(2,1) of ratings, or kappa of choices; null where nothing is compared.
const stats::Estimate* reliabilityOf(const QuestionAnchors& anchors);

}  // namespace reports
