#include "stats/claims/speed_contrasts.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "stats/kernels/decimal_grid.h"
#include "stats/tests/multiplicity.h"
#include "stats/tests/speed_accuracy.h"

namespace stats {
namespace {

using ValuesByParticipant = std::vector<Value>;

SpeedDifference speedDifference(const ValuesByParticipant& a, const ValuesByParticipant& b)
{
    std::vector<double> x, y;
    for (std::size_t k = 0; k < a.size(); ++k)
        if (a[k].exists() && b[k].exists()) {
            x.push_back(*a[k]);
            y.push_back(*b[k]);
        }
    return {pairedTTest(x, y), {}};
}

SpeedDifference uncomparedSpeed(const std::string& why)
{
    const Value none = Value::undefined(why);
    TTest test;
    test.why = why;
    test.estimate = test.sd = test.se = test.t = test.df = test.p = test.logP = test.dZ = test.hedgesGz = none;
    test.ci = {none, none};
    return {test, none};
}

void adjustMeasure(std::vector<SpeedContrastTests>& contrasts, SpeedDifference SpeedContrastTests::*measure)
{
    std::vector<Value> p;
    for (const SpeedContrastTests& contrast : contrasts) p.push_back((contrast.*measure).test.p);
    const std::vector<Value> holm = adjusted(p, Adjustment::Holm);
    for (std::size_t i = 0; i < contrasts.size(); ++i) (contrasts[i].*measure).pHolm = holm[i];
}

ValuesByParticipant pseudoRates(const ConditionSpeedCells& cells, int alternatives)
{
    std::vector<ParticipantChoices> choices;
    for (const SpeedCell& cell : cells) choices.push_back(cell.choices);
    return ratePseudoValues(choices, alternatives);
}

ValuesByParticipant logTimes(const ConditionSpeedCells& cells)
{
    ValuesByParticipant times;
    for (const SpeedCell& cell : cells) times.push_back(cell.logSeconds);
    return times;
}

bool haveAllChoices(const ConditionSpeedCells& some, const ConditionSpeedCells& whole)
{
    return std::ranges::equal(some, whole, [](const SpeedCell& one, const SpeedCell& other) {
        return one.choices.choices == other.choices.choices && one.choices.timed == other.choices.timed;
    });
}

}  // namespace

SpeedCell speedCell(std::span<const double> correct, std::span<const double> seconds)
{
    std::vector<double> logs;
    for (const double time : seconds)
        if (time > 0) logs.push_back(std::log(time));
    const auto timed = static_cast<double>(seconds.size());
    const Value mean = meanOf(seconds);
    const auto right = static_cast<double>(std::count(correct.begin(), correct.end(), 1.0));
    return {{right, static_cast<double>(correct.size()), timed * mean.orElse(0), timed}, meanOf(correct), mean, meanOf(logs)};
}

std::vector<std::vector<Value>> scoresOf(std::span<const ConditionSpeedCells> conditions)
{
    std::vector<ValuesByParticipant> result;
    for (const ConditionSpeedCells& cells : conditions) result.emplace_back(cells.size(), Value::undefined("no timed choice"));
    std::vector<double> correct, seconds;
    std::vector<Value*> places;
    for (std::size_t c = 0; c < conditions.size(); ++c)
        for (std::size_t k = 0; k < conditions[c].size(); ++k) {
            const SpeedCell& cell = conditions[c][k];
            if (!cell.share.exists() || !cell.meanSeconds.exists()) continue;
            correct.push_back(*cell.share);
            seconds.push_back(*cell.meanSeconds);
            places.push_back(&result[c][k]);
        }
    const std::vector<Value> scores = balancedIntegrationScores(correct, seconds);
    for (std::size_t i = 0; i < scores.size(); ++i) *places[i] = scores[i];
    return result;
}

SpeedPair speedPair(std::span<const ConditionSpeedCells> conditions, std::span<const std::vector<Value>> scores,
                    const ContrastPair& contrast, ConditionSpeedCells a, ConditionSpeedCells b)
{
    const ConditionSpeedCells &wholeA = conditions[contrast.first], &wholeB = conditions[contrast.second];
    assert(a.size() == wholeA.size() && b.size() == wholeB.size());
    if (haveAllChoices(a, wholeA) && haveAllChoices(b, wholeB))
        return {std::move(a), std::move(b), scores[contrast.first], scores[contrast.second]};
    std::vector<ConditionSpeedCells> compared(conditions.begin(), conditions.end());
    compared[contrast.first] = a;
    compared[contrast.second] = b;
    auto own = scoresOf(compared);
    return {std::move(a), std::move(b), std::move(own[contrast.first]), std::move(own[contrast.second])};
}

std::vector<SpeedContrastTests> speedContrasts(std::span<const SpeedPair> pairs, int alternatives)
{
    std::vector<SpeedContrastTests> tests;
    for (const SpeedPair& pair : pairs)
        tests.push_back({pair.noBits.empty()
                             ? speedDifference(pseudoRates(pair.a, alternatives), pseudoRates(pair.b, alternatives))
                             : uncomparedSpeed(pair.noBits),
                         speedDifference(pair.scoresOfA, pair.scoresOfB), speedDifference(logTimes(pair.a), logTimes(pair.b))});
    adjustMeasure(tests, &SpeedContrastTests::bitsPerSecond);
    adjustMeasure(tests, &SpeedContrastTests::score);
    adjustMeasure(tests, &SpeedContrastTests::logSeconds);
    return tests;
}

std::vector<SpeedContrastTests> speedContrasts(std::span<const ConditionSpeedCells> conditions,
                                               std::span<const std::vector<Value>> scores,
                                               std::span<const ContrastPair> contrasts, int alternatives)
{
    std::vector<SpeedPair> pairs;
    for (const auto& [a, b] : contrasts) pairs.push_back({conditions[a], conditions[b], scores[a], scores[b]});
    return speedContrasts(pairs, alternatives);
}

}  // namespace stats
