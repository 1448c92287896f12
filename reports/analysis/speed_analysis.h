// Speed and accuracy of a choice question taken together: by condition, and between conditions. Everything here holds for new
// participants and these fabrics.
#pragma once

#include <string>
#include <vector>

#include "reports/analysis/question_claims.h"
#include "reports/cells/answer_cells.h"
#include "reports/cells/common_units.h"
#include "stats/claims/speed_contrasts.h"
#include "stats/kernels/value.h"

namespace reports {

struct ConditionSpeed {
    stats::Value medianSeconds;
    stats::Value bitsPerSecond;
    stats::Value balancedIntegrationScore;  ///< mean over the participants' cells
    stats::Interval bitsPerSecondCi95;      ///< participants as a sample; see stats::informationRate
    stats::Interval scoreCi95;              ///< Student's t over participants; covers 95 % or more, since scores are relative
    stats::Interval medianSecondsCi95;      ///< over participants; see stats::medianTimeCi95
    stats::Value share;                     ///< correct choices / choices
    stats::Interval shareCi95;              ///< Student's t over the participants' shares, within 0 and 1
};

/// Student's t over the participants' shares correct, within 0 and 1.
stats::Interval shareIntervalOf(const stats::ConditionSpeedCells& under);

/// The choices and times of each participant under a condition, in the order of AnswerCells::participants().
struct ParticipantsSpeed {
    stats::ConditionSpeedCells cells;
    std::vector<std::vector<double>> times;  ///< s
};
ParticipantsSpeed speedUnder(const AnswerCells& cells, const std::string& question, const std::string& condition);
/// The same over all conditions.
ParticipantsSpeed speedOverConditions(const AnswerCells& cells, const std::string& question);

/// `scores`: the balanced integration score of each participant, standardised together with those of other conditions. Bits per
/// second are undefined where guessing is not right in 1/m of the responses (see whyNoChance()).
ConditionSpeed conditionSpeedOf(const std::vector<const StudyResponse*>& responses, const ParticipantsSpeed& under,
                                const std::vector<stats::Value>& scores, const RightOrWrong& scoring);

/// Two conditions as the tests compare them: on the choices with a time that each participant made under both, about the same
/// fabrics and in the same repetitions. Shares and times are those of the same choices. `conditions` and `scores`: the cells of
/// all conditions; `contrast`: the places of those that the units compare.
stats::SpeedPair comparedSpeed(const AnswerCells& cells, const CommonUnits& units,
                               const std::vector<stats::ConditionSpeedCells>& conditions,
                               const std::vector<std::vector<stats::Value>>& scores, const stats::ContrastPair& contrast);

struct SpeedContrast {
    std::string a;
    std::string b;
    bool planned = false;
    bool primary = false;
    stats::SpeedContrastTests tests;
};

/// Larger families are left out, because nobody reads them.
inline constexpr std::size_t mostSpeedContrasts = 400;

struct SpeedAnalysis {
    std::vector<ConditionSpeed> conditions;  ///< in the order of the conditions
    std::vector<SpeedContrast> contrasts;    ///< the family of the claims
    std::string contrastsWhy;                ///< reason where there are none
};

/// Who stamped the times of the answers to one question, and how often two entries of an answer differed.
struct StampCounts {
    std::string question;
    std::size_t answers = 0;
    std::size_t withTime = 0;           ///< a response time is known
    std::size_t touchedByDisplay = 0;   ///< the display stamped the first touch
    std::size_t touchedByOperator = 0;  ///< a key of the operator stamped it
    std::size_t secondEntries = 0;      ///< answers that were entered twice
    std::size_t differing = 0;          ///< ... of which the first two entries differed
};

/// In the order of the questions.
std::vector<StampCounts> stampCountsOf(const StudyData& data);

/// `claims`: those of the same question; their contrasts are the family.
SpeedAnalysis analyseSpeed(const StudyData& data, const AnswerCells& cells, const std::string& question,
                           const RightOrWrong& scoring, const QuestionClaims& claims);

/// A study without a choice question: every number is undefined.
std::vector<ConditionSpeed> speedWithoutChoices(const StudyData& data);

}  // namespace reports
