// Flags on data that a reader should check before believing them. No answer is removed because of a flag.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reports/cells/answer_cells.h"

namespace reports {

/// The limits of the flags. The report prints them beside the flags.
///
/// On a short scale honest ratings are often equal. Take 21 ratings around its middle with an SD of a fifth of its length. Half
/// of them are one number in 81 % of people on 3 steps, 32 % on 4 and 14 % on 5. With sameRatingSteps 0, 0.2 and 2.7 % are
/// flagged. A limit of 2 steps, max(1/2, 2/k) on k steps, would flag 19, 33 and 13 %.
struct QualityRules {
    double tooFastSeconds = 0.5;         ///< an answer below this after the touch ...
    double tooFastShare = 0.05;          ///< ... in more than this share of a participant's timed choices and ratings
    double sameRatingShare = 0.5;        ///< one rating in at least this share of a question's answers ...
    double sameRatingSteps = 3;          ///< ... and in at least that of so many steps of its scale: 3/4 where it has 4
    double sameAcrossShare = 0.8;        ///< the same number to all rating questions of a presentation
    std::size_t fewestAnswers = 10;      ///< no share is judged below this number of answers
    std::size_t fewestCatchRatings = 3;  ///< no mean rating of blank glass or of mismatches is judged below this number
    double slotBiasP = 0.01;             ///< exact test of the favourite slot against 1/m, times m slots
};

enum class FlagKind {
    MissingAnswers,
    TooFast,
    StraightLining,
    SameAcrossQuestions,
    SlotBias,
    BlankGlassRatedHigh,
    MismatchRatedHigh,
    VoidedPresentations,
};

/// "missing_answers", "too_fast", ...
std::string nameOf(FlagKind kind);

struct QualityFlag {
    std::optional<std::string> participant;  ///< none: the flag is on the whole study
    FlagKind kind = FlagKind::MissingAnswers;
    std::string why;  ///< a phrase with the numbers
};

/// Flags in the order of the study's participants, those on the whole study last.
std::vector<QualityFlag> qualityFlags(const StudyData& data, const AnswerCells& cells, const QualityRules& rules = {});

/// The same for a caller that needs nothing else of the analysis.
std::vector<QualityFlag> qualityFlags(const StudyData& data);

/// The rule of MismatchRatedHigh, for studies with anchors. It is no reason to exclude anybody.
std::string mismatchRule(const QualityRules& rules = {});

/// The rules of every study as sentences. Registered plans contain them.
std::vector<std::string> ruleSentences(const QualityRules& rules = {});

}  // namespace reports
