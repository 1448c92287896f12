// The only numbers by condition that leave a blinded study: rounded means under K-labels, once no participant is to come. Who has
// means and the answers can work out which K-label a trial has: from exact means, from means of few answers, and from two sets of
// means that differ by one participant.
#pragma once

#include <string>
#include <vector>

#include "reports/data/study_data.h"
#include "stats/kernels/value.h"

namespace reports {

/// Means exist from this number of finished participants on, and from this number of answers under each label on.
inline constexpr std::size_t fewestFinished = 3;
inline constexpr std::size_t fewestUnderLabel = 40;

/// Reason of every number by condition that a blinded report has not.
inline constexpr const char* leftOutWhileBlinded = "left out while the study is blinded";

/// Sentence of every blinded report.
inline constexpr const char* restAfterUnblinding =
    "The report shows exact numbers, tests, tables and figures by condition after the unblinding.";

/// What a study's means are made of.
struct MeansDesign {
    std::size_t answers = 0;  ///< under each label, to one question
    std::size_t labels = 0;
    std::size_t questions = 0;  ///< with numbers
};

/// The rounding step of means on a scale of this width: the next of 1, 2 and 5 times a power of ten.
///
/// A mean of n ratings lies within width / sqrt(n) by chance alone: 4 standard errors of ratings whose standard deviation is a
/// quarter of the scale. A step tells log2(width / sqrt(n) / step) bits of it. Here that is at most half a bit. All published
/// numbers, (labels - 1) x questions, tell at most 5 % of what is unknown: n x log2(labels!) bits of which trial has which label.
double meansStep(double width, const MeansDesign& design);

/// Mean rating, or share of right answers, under one label.
struct BlindedMean {
    std::string condition;
    std::size_t n = 0;  ///< answers; those in words, too, which everybody can count who knows the design
    stats::Value mean;  ///< rounded; undefined for words and few answers
};

struct BlindedQuestion {
    QuestionInfo question;
    double step = 0;                      ///< scale units, or of the share; 0 for words
    std::vector<BlindedMean> conditions;  ///< in the order of the study

    bool isRated() const { return std::holds_alternative<NumberOnScale>(scoringOf(question.kind)); }
    bool isChosen() const { return std::holds_alternative<RightOrWrong>(scoringOf(question.kind)); }
    /// Decimals of a rounded mean.
    int decimals() const;
};

struct BlindedMeans {
    std::size_t participants = 0;            ///< who have finished and gave every answer
    std::string why;                         ///< one sentence: why there are no means; empty where there are
    std::vector<BlindedQuestion> questions;  ///< in the order of the study; empty where there are no means
};

/// None before every running order has a finished participant, so that no two sets of means differ by one participant.
///
/// Shares are multiples of the step. Mean ratings are whole steps above or below the mean of all ratings, which needs no key: so
/// means that differ by chance only are usually the same.
BlindedMeans blindedMeans(const StudyData& data);

/// The study with the participants who have finished and gave every answer, and with their answers only.
StudyData finishedPart(StudyData data);

/// The study as it is known without its key: all answers under one unnamed condition and fabric, those to catch trials and
/// anchors among them. Answers carry no word on right or wrong.
StudyData withoutKey(StudyData data);

/// Removes everything of the answers: responses, touches, and what is known of trays.
void forgetAnswers(StudyData& data);

}  // namespace reports
