#include "reports/analysis/speed_analysis.h"

#include <map>

#include "stats/kernels/decimal_grid.h"
#include "stats/kernels/descriptive.h"
#include "stats/tests/speed_accuracy.h"

namespace reports {
namespace {

/// Scores of all participant x condition cells, averaged by condition. Conditions without a timed cell are left out.
std::map<std::string, stats::Value> integrationScores(const StudyData& data, const AnswerCells& cells,
                                                      const std::string& question)
{
    std::vector<std::string> owners;
    std::vector<double> correct;
    std::vector<double> seconds;
    for (const std::string& condition : data.conditions)
        for (const std::string& participant : cells.participants()) {
            const auto responses = cells.of(question, condition, participant);
            const stats::Value time = stats::meanOf(secondsOf(responses));
            const stats::Value share = stats::meanOf(valuesOf(responses));
            if (!share.exists() || !time.exists()) continue;
            owners.push_back(condition);
            correct.push_back(*share);
            seconds.push_back(*time);
        }
    const std::vector<stats::Value> scores = stats::balancedIntegrationScores(correct, seconds);
    std::map<std::string, std::vector<double>> byCondition;
    std::map<std::string, stats::Value> result;
    for (std::size_t i = 0; i < scores.size(); ++i) {
        if (!scores[i].exists())
            result.emplace(owners[i], scores[i]);
        else
            byCondition[owners[i]].push_back(*scores[i]);
    }
    for (const auto& [condition, values] : byCondition) result.emplace(condition, stats::describe(values).mean);
    return result;
}

}  // namespace

std::vector<ConditionSpeed> analyseSpeed(const StudyData& data, const AnswerCells& cells, const std::string& question,
                                         int alternatives)
{
    const auto scores = integrationScores(data, cells, question);
    std::vector<ConditionSpeed> speeds;
    for (const std::string& condition : data.conditions) {
        const auto responses = cells.of(question, condition);
        const stats::ResponseTimes times = stats::responseTimes(secondsOf(responses));
        const stats::Value correct = stats::meanOf(valuesOf(responses));
        ConditionSpeed speed{times.median, times.mean, times.mean};
        if (correct.exists() && times.mean.exists())
            speed.bitsPerSecond = stats::bitsPerSecond(*correct, alternatives, *times.mean);
        if (const auto found = scores.find(condition); found != scores.end())
            speed.balancedIntegrationScore = found->second;
        else if (times.mean.exists())
            speed.balancedIntegrationScore = stats::Value::undefined("needs at least 2 cells");
        speeds.push_back(speed);
    }
    return speeds;
}

std::vector<ConditionSpeed> speedWithoutChoices(const StudyData& data)
{
    const stats::ResponseTimes none = stats::responseTimes({});
    return std::vector<ConditionSpeed>(data.conditions.size(), {none.median, none.mean, none.mean});
}

}  // namespace reports
