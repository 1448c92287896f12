// Order, learning and fatigue: whether answers and response times change over the trials, and from the first sitting to later
// ones. Where the running orders balance the conditions over the trials, such a change does not bias a contrast; the contrast
// with and without it is the check.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "reports/analysis/question_claims.h"
#include "reports/cells/answer_cells.h"
#include "stats/claims/within_trend.h"

namespace reports {

/// A number of an answer; none where the answer does not have it.
using AnswerNumber = std::function<std::optional<double>(const StudyResponse&)>;

/// A rating, or 1 for a right and 0 for a wrong choice.
std::optional<double> numberOfAnswer(const StudyResponse& response);

/// Whether any analysed answer, or any to this question, was given under an instruction, such as to be fast.
bool isInstructed(const StudyData& data);
bool isInstructed(const StudyData& data, const std::string& question);

/// What trends hold equal: "condition and fabric", and the instruction where there is one.
std::string heldEqual(bool isInstructed);

/// The trend of `value` with `covariate` over the answers that have both, with effects of condition and fabric. Each condition
/// under each instruction has an effect of its own: a block of fast answers before a block of accurate ones is no learning.
/// Participants stand in the order of AnswerCells::participants().
stats::WithinTrend trendOf(const StudyData& data, const AnswerCells& cells, const std::string& question,
                           const AnswerNumber& covariate, const AnswerNumber& value);

/// Slopes are those for so many trials.
inline constexpr double trialsOfASlope = 10;

enum class OrderEffectKind {
    Trend,         ///< of the answers, for 10 trials
    TimeTrend,     ///< of the natural logarithm of the response time, for 10 trials
    LaterSittings  ///< answers of later sittings minus those of the first
};

struct OrderEffect {
    OrderEffectKind kind = OrderEffectKind::Trend;
    stats::WithinTrend trend;  ///< at equal condition, instruction and fabric; its test has the interval, for these fabrics
    stats::Value pHolm;        ///< after Holm's correction over all order effects of the study
};

/// The mean difference a - b over participants, as it is and without each participant's own trend over the trials. Both are
/// those of the participants who have a trend, on the fabrics that they answered under both conditions. The largest difference of
/// several contrasts is large by chance, too. So p and interval of a contrast that was picked as the largest have Bonferroni's
/// correction.
struct ContrastWithoutTrend {
    std::string a;
    std::string b;
    bool primary = false;        ///< false: the largest difference of the question's contrasts
    std::size_t pickedFrom = 1;  ///< contrasts among which it is the largest; 1 for a primary one
    std::string why;             ///< reason where there is no such contrast
    stats::TTest plain;
    stats::TTest adjusted;
};

struct QuestionOrder {
    std::string question;
    std::vector<OrderEffect> effects;  ///< one of each kind
    ContrastWithoutTrend contrast;
};

struct OrderEffects {
    std::string why;                       ///< reason where no answer says when it was given
    std::vector<QuestionOrder> questions;  ///< those with numbers
};

/// Without the corrected p values.
QuestionOrder orderOf(const StudyData& data, const AnswerCells& cells, const std::string& question, const QuestionClaims& claims);

/// Whether any answer has a trial number or a sitting.
bool knowsOrder(const StudyData& data);

/// Holm's correction over all effects.
void adjustOrderEffects(OrderEffects& effects);

/// Effects whose 95 % interval excludes 0, and the number of those that were tested.
struct OrderEffectCount {
    std::size_t shown = 0;
    std::size_t tested = 0;
};
OrderEffectCount countOf(const OrderEffects& effects);

/// Whether the 95 % interval of the mean excludes 0.
bool excludesZero(const stats::TTest& test);

}  // namespace reports
