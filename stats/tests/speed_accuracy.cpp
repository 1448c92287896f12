#include "stats/tests/speed_accuracy.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "stats/kernels/descriptive.h"
#include "stats/kernels/moments.h"
#include "stats/tests/binomial.h"

namespace stats {
namespace {

double plogp(double p, double q) { return p <= 0 ? 0 : p * std::log2(q); }

/// The longest time of each bin.
std::vector<double> binEnds(std::span<const double> seconds, std::size_t bins)
{
    std::vector<double> ascending(seconds.begin(), seconds.end());
    std::sort(ascending.begin(), ascending.end());
    std::vector<double> ends;
    for (std::size_t i = 1; i < bins; ++i)
        ends.push_back(*quantile(ascending, static_cast<double>(i) / static_cast<double>(bins)));
    ends.push_back(ascending.back());
    return ends;
}

AccuracyBin accuracyBin(const std::vector<double>& seconds, long long correct)
{
    AccuracyBin bin;
    bin.n = seconds.size();
    const auto n = static_cast<long long>(seconds.size());
    bin.ci95 = wilsonInterval(correct, n);
    if (seconds.empty()) {
        bin.meanSeconds = bin.proportionCorrect = Value::undefined("no choice took this long");
        return bin;
    }
    bin.meanSeconds = momentsOf(seconds).mean();
    bin.proportionCorrect = static_cast<double>(correct) / static_cast<double>(n);
    return bin;
}

}  // namespace

ResponseTimes responseTimes(std::span<const double> seconds)
{
    ResponseTimes times;
    times.n = seconds.size();
    std::string fault = seconds.empty() ? "there are no response times" : nonFiniteFault(seconds, "the response times");
    if (!fault.empty()) {
        times.median = times.logMean = times.geometricMean = times.mean = Value::undefined(fault);
        return times;
    }
    times.median = median(seconds);
    times.mean = momentsOf(seconds).mean();
    if (std::any_of(seconds.begin(), seconds.end(), [](double x) { return x <= 0; })) {
        times.logMean = times.geometricMean = Value::undefined("a response time is not positive");
        return times;
    }
    std::vector<double> logs(seconds.size());
    std::transform(seconds.begin(), seconds.end(), logs.begin(), [](double x) { return std::log(x); });
    times.logMean = momentsOf(logs).mean();
    times.geometricMean = std::exp(*times.logMean);
    return times;
}

Value bitsPerChoice(double proportionCorrect, int alternatives)
{
    if (alternatives < 2) return Value::undefined("a choice needs at least 2 alternatives");
    if (!(proportionCorrect >= 0 && proportionCorrect <= 1)) return Value::undefined("a proportion lies between 0 and 1");
    const double m = alternatives;
    if (proportionCorrect <= 1 / m) return 0.0;
    const double wrong = 1 - proportionCorrect;
    return std::max(0.0, std::log2(m) + plogp(proportionCorrect, proportionCorrect) + plogp(wrong, wrong / (m - 1)));
}

Value bitsPerSecond(double proportionCorrect, int alternatives, double meanSeconds)
{
    const Value bits = bitsPerChoice(proportionCorrect, alternatives);
    if (!bits.exists()) return bits;
    if (!(meanSeconds > 0) || !std::isfinite(meanSeconds)) return Value::undefined("the mean response time is not positive");
    return *bits / meanSeconds;
}

std::vector<Value> balancedIntegrationScores(std::span<const double> proportionCorrect, std::span<const double> seconds)
{
    std::string fault;
    if (proportionCorrect.size() != seconds.size())
        fault = "proportions and times differ in number";
    else if (proportionCorrect.size() < 2)
        fault = "needs at least 2 cells";
    if (fault.empty()) fault = nonFiniteFault(proportionCorrect, "the proportions");
    if (fault.empty()) fault = nonFiniteFault(seconds, "the times");
    if (!fault.empty()) return std::vector<Value>(proportionCorrect.size(), Value::undefined(fault));
    const Moments pc = momentsOf(proportionCorrect);
    const Moments rt = momentsOf(seconds);
    if (isConstant(pc) || isConstant(rt))
        return std::vector<Value>(proportionCorrect.size(),
                                  Value::undefined(isConstant(pc) ? "all proportions are equal" : "all times are equal"));
    const double sdPc = std::sqrt(pc.squares / static_cast<double>(pc.n));
    const double sdRt = std::sqrt(rt.squares / static_cast<double>(rt.n));
    std::vector<Value> scores;
    for (std::size_t i = 0; i < seconds.size(); ++i) {
        const double zPc = ((proportionCorrect[i] - pc.shift) - pc.residual) / sdPc;
        const double zRt = ((seconds[i] - rt.shift) - rt.residual) / sdRt;
        scores.push_back(zPc - zRt);
    }
    return scores;
}

ConditionalAccuracy conditionalAccuracy(std::span<const double> seconds, const std::vector<bool>& correct, std::size_t bins)
{
    ConditionalAccuracy result;
    if (seconds.size() != correct.size())
        result.why = "times and choices differ in number";
    else if (seconds.empty())
        result.why = "there are no choices";
    else if (bins == 0)
        result.why = "needs at least 1 bin";
    else
        result.why = nonFiniteFault(seconds, "the response times");
    if (!result.why.empty()) return result;
    const std::vector<double> ends = binEnds(seconds, bins);
    std::vector<std::vector<double>> times(bins);
    std::vector<long long> right(bins, 0);
    for (std::size_t i = 0; i < seconds.size(); ++i) {
        const auto bin = static_cast<std::size_t>(std::lower_bound(ends.begin(), ends.end(), seconds[i]) - ends.begin());
        times[bin].push_back(seconds[i]);
        right[bin] += correct[i] ? 1 : 0;
    }
    for (std::size_t i = 0; i < bins; ++i) result.bins.push_back(accuracyBin(times[i], right[i]));
    return result;
}

}  // namespace stats
