#include "reports/analysis/speed_analysis.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "reports/cells/chance_level.h"
#include "reports/cells/response_time.h"
#include "stats/claims/median_time.h"
#include "stats/kernels/decimal_grid.h"
#include "stats/tests/speed_accuracy.h"

namespace reports {
namespace {

using ValuesByParticipant = std::vector<stats::Value>;  // in the order of AnswerCells::participants()

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

void addParticipant(ParticipantsSpeed& speed, const std::vector<const StudyResponse*>& responses)
{
    speed.times.push_back(responseTimesOf(responses));
    speed.cells.push_back(stats::speedCell(valuesOf(responses), speed.times.back()));
}

/// The mean of the scores, or why there is none.
stats::Value meanScore(const stats::ConditionSpeedCells& under, const ValuesByParticipant& scores, const stats::Value& meanTime)
{
    if (const auto numbers = numbersAmong(scores); !numbers.empty()) return stats::meanOf(numbers);
    // Without a time the reason is the missing time, otherwise that of the standardisation.
    for (std::size_t k = 0; k < scores.size(); ++k)
        if (under[k].share.exists() && under[k].meanSeconds.exists()) return scores[k];
    return meanTime.exists() ? stats::Value::undefined("needs at least 2 cells") : meanTime;
}

std::size_t placeIn(const std::vector<std::string>& names, const std::string& name)
{
    return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

/// The contrasts of the claims, each once.
std::vector<SpeedContrast> contrastsOf(const QuestionClaims& claims)
{
    std::vector<SpeedContrast> contrasts;
    for (const ContrastFinding& finding : claims.contrasts)
        if (finding.generalisation == stats::Generalisation::TheseFabrics)
            contrasts.push_back({finding.a, finding.b, finding.planned, finding.primary, {}});
    return contrasts;
}

bool isTimed(const StudyResponse& response) { return responseTimeOf(response).has_value(); }

bool hasLogTime(const StudyResponse& response) { return logTimeOf(response).has_value(); }

stats::Value meanLogTime(const std::vector<const StudyResponse*>& responses)
{
    std::vector<double> logs;
    for (const StudyResponse* response : responses)
        if (const std::optional<double> log = logTimeOf(*response)) logs.push_back(*log);
    return stats::meanOf(logs);
}

void testContrasts(std::vector<SpeedContrast>& contrasts, const StudyData& data, const AnswerCells& cells,
                   const std::string& question, const std::vector<stats::ConditionSpeedCells>& conditions,
                   const std::vector<ValuesByParticipant>& scores, const RightOrWrong& scoring)
{
    std::vector<stats::SpeedPair> pairs;
    for (const SpeedContrast& contrast : contrasts) {
        pairs.push_back(comparedSpeed(cells, CommonUnits(cells, question, {contrast.a, contrast.b}), conditions, scores,
                                      {placeIn(data.conditions, contrast.a), placeIn(data.conditions, contrast.b)}));
        for (const std::string& condition : {contrast.b, contrast.a})
            if (std::string why = whyNoChance(scoring, cells.of(question, condition)); !why.empty())
                pairs.back().noBits = std::move(why);
    }
    auto tests = stats::speedContrasts(pairs, scoring.alternatives);
    for (std::size_t i = 0; i < contrasts.size(); ++i) contrasts[i].tests = std::move(tests[i]);
}

bool anyTimes(const std::vector<stats::ConditionSpeedCells>& conditions)
{
    return std::ranges::any_of(conditions, [](const stats::ConditionSpeedCells& under) {
        return std::ranges::any_of(under, [](const stats::SpeedCell& cell) { return cell.meanSeconds.exists(); });
    });
}

}  // namespace

stats::Interval shareIntervalOf(const stats::ConditionSpeedCells& under)
{
    std::vector<double> shares;
    for (const stats::SpeedCell& cell : under)
        if (cell.share.exists()) shares.push_back(*cell.share);
    stats::Interval interval = intervalOf(stats::oneSampleTTest(shares));
    if (interval.low.exists()) interval = {std::max(0.0, *interval.low), std::min(1.0, *interval.high)};
    return interval;
}

ParticipantsSpeed speedUnder(const AnswerCells& cells, const std::string& question, const std::string& condition)
{
    ParticipantsSpeed speed;
    for (const std::string& participant : cells.participants()) addParticipant(speed, cells.of(question, condition, participant));
    return speed;
}

ParticipantsSpeed speedOverConditions(const AnswerCells& cells, const std::string& question)
{
    ParticipantsSpeed speed;
    for (const std::string& participant : cells.participants()) addParticipant(speed, cells.ofParticipant(question, participant));
    return speed;
}

stats::SpeedPair comparedSpeed(const AnswerCells& cells, const CommonUnits& units,
                               const std::vector<stats::ConditionSpeedCells>& conditions,
                               const std::vector<ValuesByParticipant>& scores, const stats::ContrastPair& contrast)
{
    std::array<stats::ConditionSpeedCells, 2> compared;
    for (const std::string& participant : cells.participants()) {
        const AnswersByCondition timed = units.pairedAnswers(participant, isTimed);
        // A time that is not positive has no logarithm, and takes its partner with it.
        const AnswersByCondition withLog = units.pairedAnswers(participant, hasLogTime);
        for (std::size_t side = 0; side < compared.size(); ++side) {
            compared[side].push_back(stats::speedCell(valuesOf(timed[side]), responseTimesOf(timed[side])));
            compared[side].back().logSeconds = meanLogTime(withLog[side]);
        }
    }
    return stats::speedPair(conditions, scores, contrast, std::move(compared[0]), std::move(compared[1]));
}

ConditionSpeed conditionSpeedOf(const std::vector<const StudyResponse*>& responses, const ParticipantsSpeed& under,
                                const ValuesByParticipant& scores, const RightOrWrong& scoring)
{
    const stats::ResponseTimes times = stats::responseTimes(responseTimesOf(responses));
    ConditionSpeed speed;
    speed.medianSeconds = times.median;
    speed.medianSecondsCi95 =
        times.median.exists() ? stats::medianTimeCi95(under.times) : stats::Interval{times.median, times.median};
    speed.share = stats::meanOf(valuesOf(responses));
    speed.shareCi95 = shareIntervalOf(under.cells);
    speed.bitsPerSecond = speed.share.exists() ? times.mean : speed.share;
    if (speed.share.exists() && times.mean.exists())
        speed.bitsPerSecond = stats::bitsPerSecond(*speed.share, scoring.alternatives, *times.mean);
    std::vector<stats::ParticipantChoices> choices;
    for (const stats::SpeedCell& cell : under.cells) choices.push_back(cell.choices);
    speed.bitsPerSecondCi95 = stats::informationRate(choices, scoring.alternatives).ci95;
    if (const std::string why = whyNoChance(scoring, responses); !why.empty())
        speed.bitsPerSecond = speed.bitsPerSecondCi95.low = speed.bitsPerSecondCi95.high = stats::Value::undefined(why);
    speed.balancedIntegrationScore = meanScore(under.cells, scores, times.mean);
    const std::vector<double> numbers = numbersAmong(scores);
    speed.scoreCi95 = numbers.empty() ? stats::Interval{speed.balancedIntegrationScore, speed.balancedIntegrationScore}
                                      : intervalOf(stats::oneSampleTTest(numbers));
    return speed;
}

SpeedAnalysis analyseSpeed(const StudyData& data, const AnswerCells& cells, const std::string& question,
                           const RightOrWrong& scoring, const QuestionClaims& claims)
{
    std::vector<ParticipantsSpeed> speeds;
    std::vector<stats::ConditionSpeedCells> conditions;
    for (const std::string& condition : data.conditions) {
        speeds.push_back(speedUnder(cells, question, condition));
        conditions.push_back(speeds.back().cells);
    }
    const auto scores = stats::scoresOf(conditions);
    SpeedAnalysis analysis;
    for (std::size_t c = 0; c < conditions.size(); ++c)
        analysis.conditions.push_back(conditionSpeedOf(cells.of(question, data.conditions[c]), speeds[c], scores[c], scoring));
    const std::size_t count = claims.contrasts.size() / 2;
    if (!anyTimes(conditions))
        analysis.contrastsWhy = "there are no response times";
    else if (count == 0)
        analysis.contrastsWhy = "there are no contrasts of conditions";
    else if (count > mostSpeedContrasts)
        analysis.contrastsWhy = "the study has " + std::to_string(count) + " contrasts, and at most " +
                                std::to_string(mostSpeedContrasts) + " are tested: plan some in the protocol";
    else {
        analysis.contrasts = contrastsOf(claims);
        testContrasts(analysis.contrasts, data, cells, question, conditions, scores, scoring);
    }
    return analysis;
}

std::vector<ConditionSpeed> speedWithoutChoices(const StudyData& data)
{
    const stats::ResponseTimes none = stats::responseTimes({});
    const stats::Interval noInterval{none.mean, none.mean};
    return std::vector<ConditionSpeed>(
        data.conditions.size(), {none.median, none.mean, none.mean, noInterval, noInterval, noInterval, none.mean, noInterval});
}

std::vector<StampCounts> stampCountsOf(const StudyData& data)
{
    std::vector<StampCounts> counts;
    for (const QuestionInfo& question : data.questions) {
        StampCounts count{.question = question.id};
        for (const StudyResponse& response : data.responses) {
            if (response.question != question.id) continue;
            ++count.answers;
            count.withTime += responseTimeOf(response).has_value();
            count.touchedByDisplay += response.touchedBy == "display";
            count.touchedByOperator += response.touchedBy == "operator";
            count.secondEntries += response.entries.has_value();
            count.differing += response.entries.value_or(0) > 2;
        }
        counts.push_back(std::move(count));
    }
    return counts;
}

}  // namespace reports
