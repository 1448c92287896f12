#include "stats/tests/reliability.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <numbers>

#include "stats/kernels/descriptive.h"
#include "stats/kernels/distributions.h"
#include "stats/tests/binomial.h"
#include "stats/tests/intraclass.h"

namespace stats {
namespace {

constexpr std::size_t fewestForIntervals = 3;
constexpr double tailOf95 = 0.025;
/// An interval that is narrower is one point.
constexpr double narrowestInterval = 1e-9;

using RetestedParticipants = std::vector<RatingPairs>;

Interval noInterval(const std::string& why) { return {Value::undefined(why), Value::undefined(why)}; }

RatingPairs pooled(const RetestedParticipants& participants, std::size_t without)
{
    RatingPairs pairs;
    for (std::size_t i = 0; i < participants.size(); ++i)
        if (i != without) pairs.insert(pairs.end(), participants[i].begin(), participants[i].end());
    return pairs;
}

Value iccOf(const RatingPairs& pairs)
{
    BlockTable table{pairs.size(), 2, {}};
    for (const auto& [first, second] : pairs) table.values.insert(table.values.end(), {first, second});
    const IntraclassCorrelations icc = intraclassCorrelations(table);
    return icc.why.empty() ? icc.icc2
                           : Value::undefined(icc.why == "needs at least 2 targets" ? "needs at least 2 pairs" : icc.why);
}

Value withinSdOf(const RatingPairs& pairs)
{
    if (pairs.empty()) return Value::undefined("no presentation came twice");
    double squares = 0;
    for (const auto& [first, second] : pairs) squares += (second - first) * (second - first);
    return std::sqrt(squares / (2 * static_cast<double>(pairs.size())));
}

/// A statistic on a scale on which it is nearly normal, and back.
struct NormalScale {
    double (*to)(double);
    double (*from)(double);
};

/// Leaves each of n participants out once. `statistic`: without the participant of this place; of all at place n. Undefined where
/// it, or one of these, has no finite value on the scale.
Interval jackknifeInterval(std::size_t n, const std::function<Value(std::size_t)>& statistic, const NormalScale& scale)
{
    if (n < fewestForIntervals) return noInterval("needs at least 3 participants");
    const auto onScale = [&](std::size_t without) {
        const Value value = statistic(without);
        return value.exists() ? scale.to(*value) : std::nan("");
    };
    const double whole = onScale(n), count = static_cast<double>(n);
    std::vector<double> pseudo;
    for (std::size_t i = 0; i < n; ++i) pseudo.push_back(count * whole - (count - 1) * onScale(i));
    if (!std::ranges::all_of(pseudo, [](double value) { return std::isfinite(value); }))
        return noInterval("the pairs agree without any difference, or do not vary");
    const double half = studentQuantile(tailOf95, count - 1) * *describe(pseudo).sd / std::sqrt(count);
    return {scale.from(whole - half), scale.from(whole + half)};
}

Interval jackknifeInterval(const RetestedParticipants& participants, const std::function<Value(const RatingPairs&)>& statistic,
                           const NormalScale& scale)
{
    return jackknifeInterval(
        participants.size(), [&](std::size_t without) { return statistic(pooled(participants, without)); }, scale);
}

Interval limitsOf(const RatingPairs& pairs)
{
    std::vector<double> differences;
    for (const auto& [first, second] : pairs) differences.push_back(second - first);
    const Description all = describe(differences);
    if (!all.sd.exists()) return noInterval("needs at least 2 pairs");
    const double half = normalQuantile(tailOf95) * *all.sd;
    return {*all.mean - half, *all.mean + half};
}

std::vector<double> meanDifferences(const RetestedParticipants& participants)
{
    std::vector<double> means;
    for (const RatingPairs& pairs : participants) {
        double sum = 0;
        for (const auto& [first, second] : pairs) sum += second - first;
        means.push_back(sum / static_cast<double>(pairs.size()));
    }
    return means;
}

Value raised(const Value& value, const std::function<double(double)>& by) { return value.exists() ? Value(by(*value)) : value; }

/// Of a function that never falls.
Estimate raised(const Estimate& of, const std::function<double(double)>& by)
{
    return {raised(of.value, by), {raised(of.ci95.low, by), raised(of.ci95.high, by)}};
}

/// One participant's pairs, and the sum of what they agree by, 0 to 1 each.
struct ScoredPairs {
    double pairs = 0, score = 0;
};

/// Variance of the participants' weighted mean share over that of independent pairs; at least 1.
double designEffect(std::span<const ScoredPairs> participants, double share, double pairs)
{
    double squares = 0;
    for (const ScoredPairs& one : participants) {
        const double residual = one.score - share * one.pairs;
        squares += residual * residual;
    }
    const double independent = pairs * share * (1 - share), n = static_cast<double>(participants.size());
    if (n < 2 || independent <= 0) return 1;
    return std::max(1.0, squares * n / (n - 1) / independent);
}

/// Wilson's score interval of a share of `n` trials, which need not be whole.
Interval scoreInterval(double share, double n)
{
    const double z = normalQuantile(tailOf95), below = 1 + z * z / n;
    const double middle = (share + z * z / (2 * n)) / below;
    const double half = z * std::sqrt(share * (1 - share) / n + z * z / (4 * n * n)) / below;
    return {std::max(0.0, middle - half), std::min(1.0, middle + half)};
}

/// Share of pairs that agree. `twoWrong`: what two wrong choices agree by.
Estimate shareOfPairs(std::span<const RepeatedChoices> participants, double twoWrong)
{
    std::vector<ScoredPairs> scored;
    double pairs = 0, score = 0;
    for (const RepeatedChoices& one : participants) {
        if (one.pairs == 0) continue;
        const double own = static_cast<double>(one.agreeing - one.bothWrong) + twoWrong * static_cast<double>(one.bothWrong);
        scored.push_back({static_cast<double>(one.pairs), own});
        pairs += scored.back().pairs;
        score += own;
    }
    const double share = score / pairs;
    return {share, scoreInterval(share, pairs / designEffect(scored, share, pairs))};
}

/// Kappa of this agreement among m equally likely answers.
Estimate beyondChance(const Estimate& agreement, double m)
{
    return raised(agreement, [m](double share) { return (m * share - 1) / (m - 1); });
}

/// How many of n pairs would agree if the second answers belonged to other pairs of the same participant; n is at least 2.
double agreeingByChance(const RepeatedChoices& one)
{
    const auto n = static_cast<double>(one.pairs), first = static_cast<double>(one.firstWord),
               second = static_cast<double>(one.secondWord);
    return (first * second + (n - first) * (n - second) - static_cast<double>(one.agreeing)) / (n - 1);
}

bool usesBothWords(const RepeatedChoices& one)
{
    const std::size_t both = one.firstWord + one.secondWord;
    return both > 0 && both < 2 * one.pairs;
}

/// Kappa of the words of all participants but the one at place `without`; all have at least two pairs.
Value kappaOfWords(const std::vector<RepeatedChoices>& participants, std::size_t without)
{
    double pairs = 0, agreeing = 0, byChance = 0;
    for (std::size_t i = 0; i < participants.size(); ++i) {
        if (i == without || !usesBothWords(participants[i])) continue;  // the others agree as often by chance: always
        pairs += static_cast<double>(participants[i].pairs);
        agreeing += static_cast<double>(participants[i].agreeing);
        byChance += agreeingByChance(participants[i]);
    }
    if (pairs == 0) return Value::undefined("every participant used one word only, so that nothing tells agreement from a habit");
    if (!(byChance < pairs)) return Value::undefined("second answers repeat the first ones to other presentations");
    return (agreeing - byChance) / (pairs - byChance);
}

/// An interval of one point would claim that the value is known exactly.
Interval unlessPoint(const Interval& interval, const std::string& what)
{
    if (!interval.low.exists() || *interval.high - *interval.low > narrowestInterval) return interval;
    return noInterval("all participants show the same " + what + ", so that nothing tells how exact it is");
}

/// Of a kappa that exists. The jackknife has one reason for all statistics, which need not hold for words.
Interval intervalOfWords(double kappa, std::size_t participants, const std::function<Value(std::size_t)>& without)
{
    const Interval interval = jackknifeInterval(participants, without, {std::atanh, std::tanh});
    if (!interval.low.exists())
        return participants < fewestForIntervals || kappa == 1
                   ? interval
                   : noInterval("without one of the participants there is no kappa, or none between -1 and 1");
    return unlessPoint(interval, "kappa");
}

Estimate wordKappa(std::span<const RepeatedChoices> all)
{
    std::vector<RepeatedChoices> participants;
    std::ranges::copy_if(all, std::back_inserter(participants), [](const RepeatedChoices& one) { return one.pairs > 1; });
    if (participants.empty()) {
        const std::string why =
            "no participant has two presentations that came twice, so that nothing tells agreement from a habit";
        return {Value::undefined(why), noInterval(why)};
    }
    const auto without = [&](std::size_t place) { return kappaOfWords(participants, place); };
    const Value kappa = without(participants.size());
    if (!kappa.exists()) return {kappa, noInterval(kappa.why())};
    return {kappa, intervalOfWords(*kappa, participants.size(), without)};
}

}  // namespace

RatingReliability ratingReliability(std::span<const RatingPairs> all, double scaleMax, const EquivalenceOptions& bounds)
{
    RetestedParticipants participants;
    std::ranges::copy_if(all, std::back_inserter(participants), [](const RatingPairs& pairs) { return !pairs.empty(); });
    const RatingPairs pairs = pooled(participants, participants.size());
    RatingReliability result;
    result.pairs = pairs.size();
    result.participants = participants.size();
    result.icc = {iccOf(pairs), unlessPoint(jackknifeInterval(participants, iccOf, {std::atanh, std::tanh}), "ICC")};
    result.withinSd = {withinSdOf(pairs), unlessPoint(jackknifeInterval(participants, withinSdOf, {std::log, std::exp}), "SD")};
    const std::vector<double> means = meanDifferences(participants);
    result.bias = oneSampleTTest(means);
    result.biasEquivalence = equivalenceTest(TKind::OneSample, means, {}, bounds);
    result.limitsOfAgreement = limitsOf(pairs);
    result.correlationCeiling = raised(result.icc, [](double icc) { return std::sqrt(std::max(0.0, icc)); });
    const double lost = std::numbers::inv_sqrtpi / std::numbers::sqrt2;
    const auto ceiling = [&](double sd) { return scaleMax - lost * sd; };
    result.meanCeiling = raised(result.withinSd, ceiling);
    std::swap(result.meanCeiling.ci95.low, result.meanCeiling.ci95.high);  // more noise, a lower ceiling
    return result;
}

ChoiceReliability choiceReliability(std::span<const RepeatedChoices> participants, int alternatives, ChoicesCompared compared)
{
    ChoiceReliability result;
    for (const RepeatedChoices& one : participants) {
        result.pairs += one.pairs;
        result.agreeing += one.agreeing;
        result.bothWrong += one.bothWrong;
        result.participants += one.pairs > 0;
    }
    if (result.pairs == 0) {
        const std::string why = "no presentation came twice";
        for (Estimate* estimate : {&result.agreement, &result.kappa, &result.shareCeiling})
            *estimate = {Value::undefined(why), noInterval(why)};
        return result;
    }
    const double m = alternatives, answers = compared == ChoicesCompared::Outcomes ? 2 : m;
    result.agreement = shareOfPairs(participants, 1);
    const bool areWords = compared == ChoicesCompared::Words;
    result.kappa = areWords ? wordKappa(participants) : beyondChance(shareOfPairs(participants, 1 / (m - 1)), m);
    const auto largest = [answers](double kappa) { return (1 + (answers - 1) * std::sqrt(std::max(0.0, kappa))) / answers; };
    result.shareCeiling = raised(areWords ? result.kappa : beyondChance(result.agreement, answers), largest);
    return result;
}

}  // namespace stats
