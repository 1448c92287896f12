#include "reports/analysis/order_effects.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "reports/cells/common_units.h"
#include "reports/cells/response_time.h"
#include "stats/kernels/decimal_grid.h"
#include "stats/tests/multiplicity.h"

namespace reports {
namespace {

std::map<std::string, std::size_t> placesOf(const std::vector<std::string>& names)
{
    std::map<std::string, std::size_t> places;
    for (const std::string& name : names) places.emplace(name, places.size());
    return places;
}

/// Places of the instructions of a question's answers, in the order of their names. An answer without one has an empty name.
std::map<std::string, std::size_t> instructionPlaces(const AnswerCells& cells, const std::string& question)
{
    std::set<std::string> names;
    for (const std::string& participant : cells.participants())
        for (const StudyResponse* response : cells.ofParticipant(question, participant)) names.insert(response->instruction);
    return placesOf({names.begin(), names.end()});
}

std::optional<double> tensOfTrials(const StudyResponse& response)
{
    return response.trial ? std::optional(*response.trial / trialsOfASlope) : std::nullopt;
}

/// 0 for the first sitting in which each participant answered the question, 1 for later ones.
AnswerNumber laterSittingOf(const AnswerCells& cells, const std::string& question)
{
    std::map<std::string, int> first;
    for (const std::string& participant : cells.participants())
        for (const StudyResponse* response : cells.ofParticipant(question, participant))
            if (response->sitting) {
                const auto [entry, isNew] = first.emplace(participant, *response->sitting);
                entry->second = std::min(entry->second, *response->sitting);
            }
    return [first](const StudyResponse& response) {
        return response.sitting ? std::optional(*response.sitting > first.at(response.participant) ? 1.0 : 0.0) : std::nullopt;
    };
}

bool anyAnswer(const StudyData& data, const std::string& question, const AnswerNumber& number)
{
    return std::ranges::any_of(data.responses, [&](const StudyResponse& response) {
        return response.question == question && number(response).has_value();
    });
}

/// The primary contrast; without one, that with the largest difference.
const ContrastFinding* chosenContrast(const QuestionClaims& claims)
{
    const ContrastFinding* chosen = nullptr;
    for (const ContrastFinding& finding : claims.contrasts) {
        if (finding.generalisation != stats::Generalisation::TheseFabrics) continue;
        if (finding.primary) return &finding;
        if (!finding.claim.mean.estimate.exists()) continue;
        if (chosen == nullptr || std::fabs(*finding.claim.mean.estimate) > std::fabs(*chosen->claim.mean.estimate))
            chosen = &finding;
    }
    return chosen;
}

/// Contrasts that the largest difference was picked from.
std::size_t contrastsToPickFrom(const QuestionClaims& claims)
{
    return static_cast<std::size_t>(std::ranges::count_if(claims.contrasts, [](const ContrastFinding& finding) {
        return finding.generalisation == stats::Generalisation::TheseFabrics && finding.claim.mean.estimate.exists();
    }));
}

/// Paired t test with Bonferroni's correction of p and interval for so many tests.
stats::TTest bonferroniTest(const std::vector<double>& a, const std::vector<double>& b, std::size_t tests)
{
    const auto count = static_cast<double>(std::max<std::size_t>(tests, 1));
    stats::TTest test = stats::pairedTTest(a, b, {.confidence = 1 - 0.05 / count});
    if (test.p.exists()) test.p = std::min(1.0, count * *test.p);
    if (test.logP.exists()) test.logP = std::min(0.0, std::log(count) + *test.logP);
    return test;
}

/// A participant's mean under a condition after `slope` for 10 trials is taken off.
stats::Value meanWithout(double slope, const std::vector<const StudyResponse*>& responses)
{
    std::vector<double> values;
    for (const StudyResponse* response : responses)
        if (const auto number = numberOfAnswer(*response), tens = tensOfTrials(*response); number && tens)
            values.push_back(slope == 0 ? *number : *number - slope * *tens);
    return stats::meanOf(values);
}

/// On the answers with a number and a trial that both conditions share (common_units.h).
ContrastWithoutTrend contrastWithoutTrendOf(const AnswerCells& cells, const std::string& question, const QuestionClaims& claims,
                                            const stats::WithinTrend& trend)
{
    ContrastWithoutTrend contrast;
    const ContrastFinding* chosen = chosenContrast(claims);
    if (chosen == nullptr) {
        contrast.why = "there is no contrast of conditions";
        return contrast;
    }
    contrast.a = chosen->a;
    contrast.b = chosen->b;
    contrast.primary = chosen->primary;
    if (!chosen->primary) contrast.pickedFrom = contrastsToPickFrom(claims);
    std::vector<double> plainA, plainB, adjustedA, adjustedB;
    const CommonUnits units(cells, question, {contrast.a, contrast.b});
    for (std::size_t k = 0; k < trend.slopes.size(); ++k) {
        if (!trend.slopes[k].exists()) continue;
        const std::string& participant = cells.participants()[k];
        const auto common = units.answers(participant, [](const StudyResponse& response) {
            return numberOfAnswer(response).has_value() && response.trial.has_value();
        });
        const auto &a = common[0], &b = common[1];
        if (!meanWithout(0, a).exists() || !meanWithout(0, b).exists()) continue;
        plainA.push_back(*meanWithout(0, a));
        plainB.push_back(*meanWithout(0, b));
        adjustedA.push_back(*meanWithout(*trend.slopes[k], a));
        adjustedB.push_back(*meanWithout(*trend.slopes[k], b));
    }
    if (plainA.empty()) contrast.why = trend.test.why.empty() ? "nobody with a trend answered under both" : trend.test.why;
    contrast.plain = bonferroniTest(plainA, plainB, contrast.pickedFrom);
    contrast.adjusted = bonferroniTest(adjustedA, adjustedB, contrast.pickedFrom);
    return contrast;
}

}  // namespace

std::optional<double> numberOfAnswer(const StudyResponse& response)
{
    const std::vector<double> numbers = valuesOf({&response});
    return numbers.empty() ? std::nullopt : std::optional(numbers.front());
}

bool isInstructed(const StudyData& data)
{
    return std::ranges::any_of(data.responses, [](const StudyResponse& response) { return !response.instruction.empty(); });
}

bool isInstructed(const StudyData& data, const std::string& question)
{
    return std::ranges::any_of(data.responses, [&](const StudyResponse& response) {
        return response.question == question && !response.instruction.empty();
    });
}

std::string heldEqual(bool isInstructed) { return isInstructed ? "condition, instruction and fabric" : "condition and fabric"; }

stats::WithinTrend trendOf(const StudyData& data, const AnswerCells& cells, const std::string& question,
                           const AnswerNumber& covariate, const AnswerNumber& value)
{
    const auto conditions = placesOf(data.conditions), fabrics = placesOf(data.fabrics);
    const auto instructions = instructionPlaces(cells, question);
    const auto placeOf = [&](const StudyResponse& response) {
        return instructions.at(response.instruction) * conditions.size() + conditions.at(response.condition);
    };
    std::vector<std::vector<stats::TrendRow>> participants;
    for (const std::string& participant : cells.participants()) {
        std::vector<stats::TrendRow>& rows = participants.emplace_back();
        for (const StudyResponse* response : cells.ofParticipant(question, participant)) {
            const std::optional<double> x = covariate(*response), y = value(*response);
            if (x && y) rows.push_back({placeOf(*response), fabrics.at(response->fabric), *x, *y});
        }
    }
    return stats::withinTrend(participants);
}

QuestionOrder orderOf(const StudyData& data, const AnswerCells& cells, const std::string& question, const QuestionClaims& claims)
{
    const AnswerNumber later = laterSittingOf(cells, question);
    QuestionOrder order{question,
                        {{OrderEffectKind::Trend, trendOf(data, cells, question, tensOfTrials, numberOfAnswer), {}},
                         {OrderEffectKind::TimeTrend, trendOf(data, cells, question, tensOfTrials, logTimeOf), {}},
                         {OrderEffectKind::LaterSittings, trendOf(data, cells, question, later, numberOfAnswer), {}}},
                        {}};
    if (!anyAnswer(data, question, tensOfTrials))
        for (std::size_t i = 0; i < 2; ++i) order.effects[i].trend.test = stats::noTest("the answers have no trial numbers");
    else if (!anyAnswer(data, question, logTimeOf))
        order.effects[1].trend.test = stats::noTest("there are no response times");
    if (!anyAnswer(data, question, later))
        order.effects[2].trend.test = stats::noTest("the answers have no sittings");
    else if (!anyAnswer(data, question,
                        [&](const StudyResponse& one) { return later(one).value_or(0) > 0 ? std::optional(1.0) : std::nullopt; }))
        order.effects[2].trend.test = stats::noTest("every participant answered in one sitting");
    order.contrast = contrastWithoutTrendOf(cells, question, claims, order.effects.front().trend);
    return order;
}

bool knowsOrder(const StudyData& data)
{
    return std::ranges::any_of(data.responses, [](const StudyResponse& one) { return one.trial || one.sitting; });
}

void adjustOrderEffects(OrderEffects& effects)
{
    std::vector<stats::Value> p;
    for (const QuestionOrder& question : effects.questions)
        for (const OrderEffect& effect : question.effects) p.push_back(effect.trend.test.p);
    const std::vector<stats::Value> holm = stats::adjusted(p, stats::Adjustment::Holm);
    std::size_t at = 0;
    for (QuestionOrder& question : effects.questions)
        for (OrderEffect& effect : question.effects) effect.pHolm = holm[at++];
}

OrderEffectCount countOf(const OrderEffects& effects)
{
    OrderEffectCount count;
    for (const QuestionOrder& question : effects.questions)
        for (const OrderEffect& effect : question.effects) {
            count.tested += effect.trend.test.p.exists() ? 1 : 0;
            count.shown += excludesZero(effect.trend.test) ? 1 : 0;
        }
    return count;
}

bool excludesZero(const stats::TTest& test)
{
    return test.why.empty() && test.ci.low.exists() && test.ci.high.exists() && (*test.ci.low > 0 || *test.ci.high < 0);
}

}  // namespace reports
