// Flags on data that a reader should look at before believing them. Nothing is removed because of one.
#pragma once

#include "reports/analysis/answer_cells.h"
#include "reports/data/study_data.h"
#include "reports/text/number_text.h"

namespace reports {

/// What is flagged; stated in the report beside the flags.
struct QualityRules {
    double tooFastSeconds = 0.5;         ///< an answer below this after the touch ...
    double tooFastShare = 0.05;          ///< ... in more than this share of a participant's timed answers
    double sameRatingShare = 0.5;        ///< one rating value in at least this share of a question's answers
    double sameAcrossShare = 0.8;        ///< the same number to all rating questions of a presentation
    std::size_t fewestAnswers = 10;      ///< below this a share says nothing
    std::size_t fewestCatchRatings = 3;  ///< below this the mean rating of blank glass says nothing
    double slotBiasP = 0.01;             ///< exact test of the favourite slot against 1/m, times m slots
};

/// [{"participant": id or null, "flag": name, "why": sentence}]; flags: missing_answers, too_fast,
/// straight_lining, same_across_questions, slot_bias, blank_glass_rated_high, voided_presentations.
Json qualityFlags(const StudyData& data, const Cells& cells, const QualityRules& rules = {});

/// Answers that a complete study would hold, and how many are missing.
struct Completeness {
    std::size_t expected = 0;
    std::size_t present = 0;
    std::size_t missing() const { return expected > present ? expected - present : 0; }
};
Completeness completenessOf(const StudyData& data, const Cells& cells);

/// The rules as sentences.
std::vector<std::string> ruleSentences(const QualityRules& rules = {});

}  // namespace reports
