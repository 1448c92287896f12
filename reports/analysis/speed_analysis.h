// Speed and accuracy of a choice question taken together: by condition, and between conditions. Everything here holds for new
// participants and these fabrics.
#pragma once

#include <string>
#include <vector>

#include "reports/analysis/question_claims.h"
#include "reports/cells/answer_cells.h"
#include "stats/kernels/value.h"
#include "stats/tests/t_tests.h"

namespace reports {

struct ConditionSpeed {
    stats::Value medianSeconds;
    stats::Value bitsPerSecond;
    stats::Value balancedIntegrationScore;  ///< mean over the participants' cells
    stats::Interval bitsPerSecondCi95;      ///< participants as a sample; see stats::informationRate
    stats::Interval scoreCi95;              ///< Student's t over the participants' scores
};

/// A difference of conditions a - b over the participants who have both.
struct SpeedDifference {
    stats::TTest test;   ///< paired
    stats::Value pHolm;  ///< after Holm's correction over the contrasts of the question
};

struct SpeedContrast {
    std::string a;
    std::string b;
    bool planned = false;
    bool primary = false;
    SpeedDifference bitsPerSecond;  ///< of the participants' jackknife pseudo-values
    SpeedDifference score;          ///< of the balanced integration scores
    SpeedDifference logSeconds;     ///< of the participants' mean logarithms of the time; exp is a ratio of times
};

/// Larger families are left out, because nobody reads them.
inline constexpr std::size_t mostSpeedContrasts = 400;

struct SpeedAnalysis {
    std::vector<ConditionSpeed> conditions;  ///< in the order of the conditions
    std::vector<SpeedContrast> contrasts;    ///< the family of the claims
    std::string contrastsWhy;                ///< reason where there are none
};

/// `claims`: those of the same question; their contrasts are the family.
SpeedAnalysis analyseSpeed(const StudyData& data, const AnswerCells& cells, const std::string& question, int alternatives,
                           const QuestionClaims& claims);

/// A study without a choice question: every number is undefined.
std::vector<ConditionSpeed> speedWithoutChoices(const StudyData& data);

}  // namespace reports
