#include "reports/analysis/accuracy_by_speed.h"

#include <algorithm>
#include <cmath>

#include "reports/analysis/order_effects.h"
#include "reports/cells/response_time.h"
#include "stats/kernels/decimal_grid.h"
#include "stats/tests/speed_accuracy.h"
#include "stats/tests/t_tests.h"

namespace reports {
namespace {

constexpr std::size_t fewestChoicesOfABin = 2;

/// The bins of one participant; none with too few timed choices.
std::vector<stats::AccuracyBin> binsOfOne(const std::vector<const StudyResponse*>& responses, std::size_t count)
{
    std::vector<double> times;
    std::vector<bool> correct;
    for (const StudyResponse* response : responses) {
        const auto time = responseTimeOf(*response), number = numberOfAnswer(*response);
        if (!time || !number) continue;
        times.push_back(*time);
        correct.push_back(*number == 1);
    }
    if (times.size() < fewestChoicesOfABin * count) return {};
    return stats::conditionalAccuracy(times, correct, count).bins;
}

stats::Interval withinShares(const stats::TTest& test)
{
    if (!test.why.empty()) return {stats::Value::undefined(test.why), stats::Value::undefined(test.why)};
    return {std::max(0.0, *test.ci.low), std::min(1.0, *test.ci.high)};
}

/// The same bin of several participants. A participant whose equal times leave the bin empty is left out.
SpeedBin overParticipants(const std::vector<std::vector<stats::AccuracyBin>>& participants, std::size_t place)
{
    SpeedBin bin;
    std::vector<double> times, shares;
    for (const std::vector<stats::AccuracyBin>& bins : participants) {
        if (bins[place].n == 0) continue;
        bin.choices += bins[place].n;
        times.push_back(*bins[place].meanSeconds);
        shares.push_back(*bins[place].proportionCorrect);
    }
    bin.participants = shares.size();
    bin.meanSeconds = stats::meanOf(times);
    bin.share = stats::meanOf(shares);
    bin.ci95 = withinShares(stats::oneSampleTTest(shares));
    return bin;
}

std::vector<SpeedBin> allBins(const std::vector<std::vector<stats::AccuracyBin>>& participants, std::size_t count)
{
    std::vector<SpeedBin> bins;
    for (std::size_t place = 0; place < count && !participants.empty(); ++place)
        bins.push_back(overParticipants(participants, place));
    return bins;
}

/// Four where half of the cells of participant and condition have two choices for each bin.
std::size_t binsOfConditions(const StudyData& data, const AnswerCells& cells, const std::string& question)
{
    std::vector<std::size_t> counts;
    for (const std::string& condition : data.conditions)
        for (const std::string& participant : cells.participants())
            if (const auto times = responseTimesOf(cells.of(question, condition, participant)); !times.empty())
                counts.push_back(times.size());
    std::sort(counts.begin(), counts.end());
    return !counts.empty() && counts[counts.size() / 2] >= fewestChoicesOfABin * speedBins ? speedBins : 2;
}

}  // namespace

AccuracyBySpeed accuracyBySpeed(const StudyData& data, const AnswerCells& cells, const std::string& question)
{
    AccuracyBySpeed result;
    std::vector<std::vector<stats::AccuracyBin>> participants;
    bool anyTime = false;
    for (const std::string& participant : cells.participants()) {
        const auto responses = cells.ofParticipant(question, participant);
        anyTime = anyTime || !responseTimesOf(responses).empty();
        const auto bins = binsOfOne(responses, speedBins);
        if (bins.empty()) continue;
        participants.push_back(bins);
        ParticipantSpeed one{participant, {}, {}};
        for (const stats::AccuracyBin& bin : bins) {
            one.meanSeconds.push_back(bin.meanSeconds);
            one.shares.push_back(bin.proportionCorrect);
        }
        result.participants.push_back(std::move(one));
    }
    result.bins = allBins(participants, speedBins);
    if (!anyTime)
        result.why = "there are no response times";
    else if (participants.empty())
        result.why = "nobody has " + std::to_string(fewestChoicesOfABin * speedBins) + " timed choices";
    result.conditionBins = binsOfConditions(data, cells, question);
    for (const std::string& condition : data.conditions) {
        std::vector<std::vector<stats::AccuracyBin>> under;
        for (const std::string& participant : cells.participants())
            if (auto bins = binsOfOne(cells.of(question, condition, participant), result.conditionBins); !bins.empty())
                under.push_back(std::move(bins));
        result.conditions.push_back(allBins(under, result.conditionBins));
    }
    result.trend = trendOf(
        data, cells, question,
        [](const StudyResponse& response) {
            const auto logTime = logTimeOf(response);
            return logTime ? std::optional(*logTime / std::log(2.0)) : std::nullopt;
        },
        numberOfAnswer);
    return result;
}

}  // namespace reports
