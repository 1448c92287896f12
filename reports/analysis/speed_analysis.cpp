#include "reports/analysis/speed_analysis.h"

#include <algorithm>
#include <cmath>

#include "reports/cells/response_time.h"
#include "stats/claims/information_rate.h"
#include "stats/kernels/decimal_grid.h"
#include "stats/tests/multiplicity.h"
#include "stats/tests/speed_accuracy.h"

namespace reports {
namespace {

using ValuesByParticipant = std::vector<stats::Value>;  // in the order of AnswerCells::participants()

/// What a condition gives for each participant.
struct ConditionCells {
    std::vector<stats::ParticipantChoices> choices;
    ValuesByParticipant shares, meanTimes, logSeconds, scores;
};

ConditionCells cellsUnder(const AnswerCells& cells, const std::string& question, const std::string& condition)
{
    ConditionCells under;
    for (const std::string& participant : cells.participants()) {
        const auto responses = cells.of(question, condition, participant);
        const std::vector<double> values = valuesOf(responses), times = responseTimesOf(responses);
        std::vector<double> logTimes;
        for (const StudyResponse* response : responses)
            if (const auto logTime = logTimeOf(*response)) logTimes.push_back(*logTime);
        under.shares.push_back(stats::meanOf(values));
        under.meanTimes.push_back(stats::meanOf(times));
        under.logSeconds.push_back(stats::meanOf(logTimes));
        const auto timed = static_cast<double>(times.size());
        under.choices.push_back({static_cast<double>(correctAmong(values)), static_cast<double>(values.size()),
                                 timed * under.meanTimes.back().orElse(0), timed});
    }
    return under;
}

/// Scores of all participant x condition cells that have a share and a time; both are standardised over all of them.
void addScores(std::vector<ConditionCells>& conditions)
{
    std::vector<double> correct, seconds;
    std::vector<stats::Value*> places;
    for (ConditionCells& under : conditions) {
        under.scores.assign(under.shares.size(), stats::Value::undefined("no timed choice"));
        for (std::size_t k = 0; k < under.shares.size(); ++k) {
            if (!under.shares[k].exists() || !under.meanTimes[k].exists()) continue;
            correct.push_back(*under.shares[k]);
            seconds.push_back(*under.meanTimes[k]);
            places.push_back(&under.scores[k]);
        }
    }
    const std::vector<stats::Value> scores = stats::balancedIntegrationScores(correct, seconds);
    for (std::size_t i = 0; i < scores.size(); ++i) *places[i] = scores[i];
}

/// The values that exist.
std::vector<double> numbersAmong(const ValuesByParticipant& values)
{
    std::vector<double> numbers;
    for (const stats::Value& value : values)
        if (value.exists()) numbers.push_back(*value);
    return numbers;
}

stats::Interval intervalOf(const stats::TTest& test)
{
    if (test.why.empty()) return test.ci;
    return {stats::Value::undefined(test.why), stats::Value::undefined(test.why)};
}

/// The mean of the scores, or why there is none.
stats::Value meanScore(const ConditionCells& under, const stats::Value& meanTime)
{
    if (const auto scores = numbersAmong(under.scores); !scores.empty()) return stats::meanOf(scores);
    // Without a time the reason is the missing time, otherwise that of the standardisation.
    for (std::size_t k = 0; k < under.scores.size(); ++k)
        if (under.shares[k].exists() && under.meanTimes[k].exists()) return under.scores[k];
    return meanTime.exists() ? stats::Value::undefined("needs at least 2 cells") : meanTime;
}

ConditionSpeed speedOf(const std::vector<const StudyResponse*>& responses, const ConditionCells& under, int alternatives)
{
    const stats::ResponseTimes times = stats::responseTimes(responseTimesOf(responses));
    const stats::Value correct = stats::meanOf(valuesOf(responses));
    ConditionSpeed speed{times.median, times.mean, meanScore(under, times.mean), {}, {}};
    if (correct.exists() && times.mean.exists()) speed.bitsPerSecond = stats::bitsPerSecond(*correct, alternatives, *times.mean);
    speed.bitsPerSecondCi95 = stats::informationRate(under.choices, alternatives).ci95;
    const std::vector<double> scores = numbersAmong(under.scores);
    speed.scoreCi95 = scores.empty() ? stats::Interval{speed.balancedIntegrationScore, speed.balancedIntegrationScore}
                                     : intervalOf(stats::oneSampleTTest(scores));
    return speed;
}

SpeedDifference differenceOf(const ValuesByParticipant& a, const ValuesByParticipant& b)
{
    std::vector<double> x, y;
    for (std::size_t k = 0; k < a.size(); ++k)
        if (a[k].exists() && b[k].exists()) {
            x.push_back(*a[k]);
            y.push_back(*b[k]);
        }
    return {stats::pairedTTest(x, y), {}};
}

void adjustFamily(std::vector<SpeedContrast>& contrasts, SpeedDifference SpeedContrast::*measure)
{
    std::vector<stats::Value> p;
    for (const SpeedContrast& contrast : contrasts) p.push_back((contrast.*measure).test.p);
    const std::vector<stats::Value> holm = stats::adjusted(p, stats::Adjustment::Holm);
    for (std::size_t i = 0; i < contrasts.size(); ++i) (contrasts[i].*measure).pHolm = holm[i];
}

std::size_t placeIn(const std::vector<std::string>& names, const std::string& name)
{
    return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

/// The contrasts of the claims, each once.
std::vector<SpeedContrast> contrastsOf(const StudyData& data, const std::vector<ConditionCells>& conditions, int alternatives,
                                       const QuestionClaims& claims)
{
    std::vector<ValuesByParticipant> rates;
    for (const ConditionCells& under : conditions) rates.push_back(stats::ratePseudoValues(under.choices, alternatives));
    std::vector<SpeedContrast> contrasts;
    for (const ContrastFinding& finding : claims.contrasts) {
        if (finding.generalisation != stats::Generalisation::TheseFabrics) continue;
        const std::size_t a = placeIn(data.conditions, finding.a), b = placeIn(data.conditions, finding.b);
        contrasts.push_back({finding.a, finding.b, finding.planned, finding.primary, differenceOf(rates[a], rates[b]),
                             differenceOf(conditions[a].scores, conditions[b].scores),
                             differenceOf(conditions[a].logSeconds, conditions[b].logSeconds)});
    }
    adjustFamily(contrasts, &SpeedContrast::bitsPerSecond);
    adjustFamily(contrasts, &SpeedContrast::score);
    adjustFamily(contrasts, &SpeedContrast::logSeconds);
    return contrasts;
}

bool anyTimes(const std::vector<ConditionCells>& conditions)
{
    return std::ranges::any_of(conditions, [](const ConditionCells& under) {
        return std::ranges::any_of(under.meanTimes, [](const stats::Value& value) { return value.exists(); });
    });
}

}  // namespace

SpeedAnalysis analyseSpeed(const StudyData& data, const AnswerCells& cells, const std::string& question, int alternatives,
                           const QuestionClaims& claims)
{
    std::vector<ConditionCells> conditions;
    for (const std::string& condition : data.conditions) conditions.push_back(cellsUnder(cells, question, condition));
    addScores(conditions);
    SpeedAnalysis analysis;
    for (std::size_t c = 0; c < conditions.size(); ++c)
        analysis.conditions.push_back(speedOf(cells.of(question, data.conditions[c]), conditions[c], alternatives));
    const std::size_t count = claims.contrasts.size() / 2;
    if (!anyTimes(conditions))
        analysis.contrastsWhy = "there are no response times";
    else if (count == 0)
        analysis.contrastsWhy = "there are no contrasts of conditions";
    else if (count > mostSpeedContrasts)
        analysis.contrastsWhy = "the study has " + std::to_string(count) + " contrasts, and at most " +
                                std::to_string(mostSpeedContrasts) + " are tested: plan some in the protocol";
    else
        analysis.contrasts = contrastsOf(data, conditions, alternatives, claims);
    return analysis;
}

std::vector<ConditionSpeed> speedWithoutChoices(const StudyData& data)
{
    const stats::ResponseTimes none = stats::responseTimes({});
    const stats::Interval noInterval{none.mean, none.mean};
    return std::vector<ConditionSpeed>(data.conditions.size(), {none.median, none.mean, none.mean, noInterval, noInterval});
}

}  // namespace reports
