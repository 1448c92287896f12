// Everything that the report computes from a study, as one value. Tables, figures, page and files only read it.
#pragma once

#include <memory>
#include <variant>
#include <vector>

#include "reports/analysis/choice_analysis.h"
#include "reports/analysis/false_claims.h"
#include "reports/analysis/group_analysis.h"
#include "reports/analysis/order_effects.h"
#include "reports/analysis/plan_comparison.h"
#include "reports/analysis/quality_flags.h"
#include "reports/analysis/rating_analysis.h"
#include "reports/analysis/screening.h"
#include "reports/analysis/speed_analysis.h"
#include "reports/analysis/worded_analysis.h"
#include "reports/cells/anchor_answers.h"
#include "reports/cells/blinded_means.h"
#include "reports/cells/touch_by_condition.h"
#include "reports/data/analysis_options.h"
#include "reports/data/study_data.h"
#include "stats/tests/speed_accuracy.h"

namespace reports {

/// What is known about a question, by how its answers are scored.
using QuestionFindings = std::variant<ChoiceAnalysis, RatingAnalysis, WordedAnalysis>;

struct QuestionAnalysis {
    QuestionInfo question;
    QuestionFindings findings;
    std::vector<std::size_t> missing;         ///< answers, by condition
    std::vector<stats::ResponseTimes> times;  ///< by condition; empty for words, which take as long as one likes
};

/// Answers that a complete study would hold, and those that there are.
struct Completeness {
    std::size_t expected = 0;
    std::size_t present = 0;
    std::size_t ofEmptyPlaces = 0;  ///< missing ones of running orders that nobody has
    std::size_t missing() const { return expected > present ? expected - present : 0; }
};

struct StudyAnalysis {
    StudyData data;
    Depth depth = Depth::Whole;
    std::vector<QuestionAnalysis> questions;  ///< in the order of the study
    std::vector<ConditionSpeed> speed;        ///< by condition, of the first choice question
    std::vector<QuestionAnchors> anchors;     ///< of questions with answers to anchors
    std::vector<ConditionTouch> touch;        ///< by condition; empty without samples of the finger
    OrderEffects order;
    std::vector<QualityFlag> flags;
    Screening screening;
    std::shared_ptr<const StudyAnalysis>
        withoutFlagged;  ///< a quick analysis of the rest; null where there is none or depth is Quick
    GroupAnalysis groups;
    std::vector<FalseClaimFinding> falseClaims;
    std::vector<std::string> designLimits;  ///< what is left out or taken for granted, as sentences
    Completeness completeness;
    PlanComparison plan;
    BlindedMeans blindedMeans;  ///< of a blinded study
};

/// A blinded study has these findings only: blindedMeans and plan over participants who have finished; flags, excluded
/// participants and completeness over all answers, as they are known without the key. Everything else is empty, and so are the
/// answers in `data`. Throws workFailed where answers contradict the study's own lists (see AnswerCells).
StudyAnalysis analyse(StudyData data, const AnalysisOptions& options = {});

/// A question whose findings are of one kind.
template <class Findings>
struct AnalysedQuestion {
    const QuestionAnalysis& analysis;
    const Findings& findings;

    const std::string& id() const { return analysis.question.id; }
};

/// The questions whose findings are of one kind, in the order of the study.
template <class Findings>
std::vector<AnalysedQuestion<Findings>> questionsWith(const StudyAnalysis& analysis)
{
    std::vector<AnalysedQuestion<Findings>> questions;
    for (const QuestionAnalysis& question : analysis.questions)
        if (const auto* findings = std::get_if<Findings>(&question.findings)) questions.push_back({question, *findings});
    return questions;
}

/// Pairs of conditions of a question; none where its answers are words.
const std::vector<PairComparison>& comparisonsOf(const QuestionAnalysis& question);
const std::vector<PairEquivalence>& equivalencesOf(const QuestionAnalysis& question);
/// Claims about a question; null where its answers are words.
const QuestionClaims* claimsOf(const QuestionAnalysis& question);
/// Effect sizes of a question; null where its answers are words.
const QuestionEffects* effectsOf(const QuestionAnalysis& question);
/// The unit of the variances of a question's mixed model: "log odds" or "scale points".
std::string unitOf(const QuestionAnalysis& question);

}  // namespace reports
