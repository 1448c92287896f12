#include "stats/claims/information_rate.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "stats/tests/speed_accuracy.h"
#include "stats/tests/t_tests.h"

namespace stats {
namespace {

bool hasChoices(const ParticipantChoices& one) { return one.choices > 0 && one.timed > 0; }

ParticipantChoices sumOf(std::span<const ParticipantChoices> participants)
{
    ParticipantChoices sum;
    for (const ParticipantChoices& one : participants) {
        sum.correct += one.correct;
        sum.choices += one.choices;
        sum.totalSeconds += one.totalSeconds;
        sum.timed += one.timed;
    }
    return sum;
}

Value rateOf(const ParticipantChoices& sum, int alternatives)
{
    if (!(sum.choices > 0)) return Value::undefined("there are no choices");
    if (!(sum.timed > 0)) return Value::undefined("there are no response times");
    return bitsPerSecond(sum.correct / sum.choices, alternatives, sum.totalSeconds / sum.timed);
}

Interval withoutInterval(const std::string& why) { return {Value::undefined(why), Value::undefined(why)}; }

/// Limits of a ratio from the limits of its independent numerator and denominator, all positive or 0.
Interval ratioLimits(double top, const Interval& topCi, double bottom, const Interval& bottomCi)
{
    const double topLow = std::min(*topCi.low, top), topHigh = std::max(*topCi.high, top);
    const double low = std::min(*bottomCi.low, bottom), high = std::max(*bottomCi.high, bottom);
    const double fromHigh = high * (2 * bottom - high), fromLow = low * (2 * bottom - low);
    if (!(low > 0 && fromHigh > 0)) return withoutInterval("the interval of the mean response time reaches 0");
    const double product = top * bottom;
    const auto root = [&](double inner) { return std::sqrt(std::max(0.0, product * product - inner)); };
    return {std::max(0.0, (product - root(topLow * (2 * top - topLow) * fromHigh)) / fromHigh),
            (product + root(topHigh * (2 * top - topHigh) * fromLow)) / fromLow};
}

}  // namespace

InformationRate informationRate(std::span<const ParticipantChoices> participants, int alternatives)
{
    const ParticipantChoices sum = sumOf(participants);
    InformationRate result{rateOf(sum, alternatives), {}};
    if (!result.rate.exists()) return {result.rate, withoutInterval(result.rate.why())};
    std::vector<double> shares, times;
    for (const ParticipantChoices& one : participants) {
        if (one.choices > 0) shares.push_back(one.correct / one.choices);
        if (one.timed > 0) times.push_back(one.totalSeconds / one.timed);
    }
    const TTest share = oneSampleTTest(shares), time = oneSampleTTest(times);
    if (!share.why.empty() || !time.why.empty())
        return {result.rate, withoutInterval(!share.why.empty() ? "share correct: " + share.why : "response time: " + time.why)};
    const auto bitsAt = [&](const Value& limit) { return bitsPerChoice(std::clamp(*limit, 0.0, 1.0), alternatives); };
    const double bits = *bitsPerChoice(sum.correct / sum.choices, alternatives);
    result.ci95 = ratioLimits(bits, {bitsAt(share.ci.low), bitsAt(share.ci.high)}, sum.totalSeconds / sum.timed, time.ci);
    return result;
}

std::vector<Value> ratePseudoValues(std::span<const ParticipantChoices> participants, int alternatives)
{
    const ParticipantChoices sum = sumOf(participants);
    const Value whole = rateOf(sum, alternatives);
    const auto n = static_cast<double>(std::count_if(participants.begin(), participants.end(), hasChoices));
    std::vector<Value> values;
    for (const ParticipantChoices& one : participants) {
        if (!hasChoices(one) || n < 2 || !whole.exists()) {
            values.push_back(Value::undefined(!whole.exists()   ? whole.why()
                                              : hasChoices(one) ? "needs at least 2 participants"
                                                                : "no timed choice"));
            continue;
        }
        const Value rest = rateOf(
            {sum.correct - one.correct, sum.choices - one.choices, sum.totalSeconds - one.totalSeconds, sum.timed - one.timed},
            alternatives);
        values.push_back(rest.exists() ? Value(n * *whole - (n - 1) * *rest) : rest);
    }
    return values;
}

}  // namespace stats
