// The only numbers by condition that leave a blinded study: rounded means under K-labels, over participants who have finished.
// Who has exact means and the answers can work out which K-label each trial has.
#pragma once

#include <string>
#include <vector>

#include "reports/data/study_data.h"
#include "stats/kernels/value.h"

namespace reports {

/// Means exist from this number of finished participants on.
inline constexpr std::size_t fewestFinished = 3;

/// Shares of right answers are multiples of 0.05 from 60 answers on, and of 0.25 below: each multiple stands for several counts.
/// There are none below `fewestChoices` answers, of which a quarter would still be an exact count.
double shareStep(std::size_t answers);
inline constexpr std::size_t fewestChoices = 12;

/// Reason of every number by condition that a blinded report has not.
inline constexpr const char* leftOutWhileBlinded = "left out while the study is blinded";

/// Sentence of every blinded report.
inline constexpr const char* restAfterUnblinding =
    "The report shows exact numbers, tests, tables and figures by condition after the unblinding.";

/// Mean rating, or share of right answers, under one label.
struct BlindedMean {
    std::string condition;
    std::size_t n = 0;  ///< answers
    stats::Value mean;  ///< a multiple of the question's step; undefined for words
};

struct BlindedQuestion {
    QuestionInfo question;
    double step = 0;                      ///< scale units, or shareStep() of the fewest answers; 0 for words
    std::vector<BlindedMean> conditions;  ///< in the order of the study

    bool isRated() const { return std::holds_alternative<NumberOnScale>(scoringOf(question.kind)); }
    bool isChosen() const { return std::holds_alternative<RightOrWrong>(scoringOf(question.kind)); }
    /// Decimals of a multiple of the step.
    int decimals() const;
};

struct BlindedMeans {
    std::size_t participants = 0;            ///< who have finished
    std::string why;                         ///< one sentence: why there are no means; empty where there are
    std::vector<BlindedQuestion> questions;  ///< in the order of the study; empty where there are no means
};

/// Takes the answers of participants who have finished only. So no single answer of a running session changes it.
BlindedMeans blindedMeans(const StudyData& data);

/// The study with the participants who have finished and have answers, and with their answers only.
StudyData finishedPart(StudyData data);

/// Removes everything of the answers: responses, touches, and what is known of trays.
void forgetAnswers(StudyData& data);

}  // namespace reports
