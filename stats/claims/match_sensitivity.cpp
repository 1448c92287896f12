#include "stats/claims/match_sensitivity.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "stats/kernels/distributions.h"

namespace stats {
namespace {

/// Both indices of the same counts.
struct Indices {
    double dPrime = 0;
    double criterion = 0;
};

double correctedRate(std::size_t said, std::size_t of)
{
    return (static_cast<double>(said) + 0.5) / (static_cast<double>(of) + 1);
}

Indices indicesOf(const MatchCounts& counts)
{
    const double hit = -normalQuantile(correctedRate(counts.hits, counts.same));
    const double falseAlarm = -normalQuantile(correctedRate(counts.falseAlarms, counts.different));
    return {hit - falseAlarm, -(hit + falseAlarm) / 2};
}

void add(MatchCounts& counts, const MatchAnswer& answer)
{
    ++(answer.wasSame ? counts.same : counts.different);
    if (answer.saidSame) ++(answer.wasSame ? counts.hits : counts.falseAlarms);
}

MatchCounts without(const MatchCounts& all, const MatchCounts& part)
{
    return {all.hits - part.hits, all.same - part.same, all.falseAlarms - part.falseAlarms, all.different - part.different};
}

/// The clusters of answers: a participant, a fabric, or a cell of both.
template <typename ClusterOf>
std::vector<MatchCounts> clustersOf(const std::vector<MatchAnswer>& answers, ClusterOf clusterOf)
{
    std::map<decltype(clusterOf(answers.front())), MatchCounts> counts;
    for (const MatchAnswer& answer : answers) add(counts[clusterOf(answer)], answer);
    std::vector<MatchCounts> clusters;
    for (const auto& [cluster, ofCluster] : counts) clusters.push_back(ofCluster);
    return clusters;
}

/// The largest difference that rounding leaves between equal indices.
constexpr double roundingOfIndices = 1e-12;

/// Whether leaving out one cluster or another changes the index.
bool varies(const std::vector<Indices>& left, double Indices::*index)
{
    const auto [low, high] = std::ranges::minmax(left, {}, index);
    return high.*index - low.*index > roundingOfIndices;
}

/// The jackknife's variances of both indices; zero with one cluster, and where all clusters have the same answers.
Indices jackknifeVariances(const MatchCounts& all, const std::vector<MatchCounts>& clusters)
{
    const auto n = static_cast<double>(clusters.size());
    if (clusters.size() < 2) return {};
    std::vector<Indices> left;
    Indices mean;
    for (const MatchCounts& cluster : clusters) {
        left.push_back(indicesOf(without(all, cluster)));
        mean.dPrime += left.back().dPrime / n;
        mean.criterion += left.back().criterion / n;
    }
    Indices variance;
    for (const Indices& one : left) {
        variance.dPrime += (n - 1) / n * (one.dPrime - mean.dPrime) * (one.dPrime - mean.dPrime);
        variance.criterion += (n - 1) / n * (one.criterion - mean.criterion) * (one.criterion - mean.criterion);
    }
    for (double Indices::*const index : {&Indices::dPrime, &Indices::criterion})
        if (!varies(left, index)) variance.*index = 0;
    return variance;
}

Interval around(double estimate, double variance, std::size_t clusters, const char* what)
{
    if (clusters < 2) {
        const Value none = Value::undefined(std::string("an interval needs two ") + what);
        return {none, none};
    }
    if (!(variance > 0)) {
        const Value none = Value::undefined("no variation: all have the same rates");
        return {none, none};
    }
    const double reach = studentQuantile(0.025, static_cast<double>(clusters - 1)) * std::sqrt(variance);
    return {estimate - reach, estimate + reach};
}

/// What varies, once for each index.
struct Variances {
    double participants = 0, fabrics = 0, cells = 0;

    /// Not below the variance of either alone: the difference of estimates may be.
    double both() const { return std::max({participants, fabrics, participants + fabrics - cells}); }
};

ClusteredIndex clustered(double estimate, const Variances& variances, std::size_t participants, std::size_t fabrics)
{
    ClusteredIndex index{estimate, around(estimate, variances.participants, participants, "participants"), {}};
    const bool fewerFabrics = fabrics < participants;
    index.overBoth =
        around(estimate, variances.both(), std::min(fabrics, participants), fewerFabrics ? "fabrics" : "participants");
    return index;
}

/// Variance of z of a rate that was counted in `of` pairs.
double varianceOfZ(std::size_t said, std::size_t of)
{
    const double rate = correctedRate(said, of);
    const double z = normalQuantile(rate);
    const double density = std::exp(-z * z / 2) / std::sqrt(2 * std::numbers::pi);
    return rate * (1 - rate) / (static_cast<double>(of) + 1) / (density * density);
}

}  // namespace

MatchSensitivity matchSensitivity(const std::vector<MatchAnswer>& answers)
{
    MatchSensitivity result;
    for (const MatchAnswer& answer : answers) add(result.counts, answer);
    const MatchCounts& all = result.counts;
    if (all.same == 0) result.why = "no pair was the same";
    if (all.different == 0) result.why = all.same == 0 ? "no answer says \"same\" or \"different\"" : "no pair differed";
    const Value none = Value::undefined(result.why);
    const auto rate = [&](std::size_t said, std::size_t of) {
        return of == 0 ? none : Value(static_cast<double>(said) / static_cast<double>(of));
    };
    result.hitRate = rate(all.hits, all.same);
    result.falseAlarmRate = rate(all.falseAlarms, all.different);
    if (!result.why.empty()) {
        result.dPrime = result.criterion = {none, {none, none}, {none, none}};
        result.seDPrime = none;
        return result;
    }
    const auto participants = clustersOf(answers, [](const MatchAnswer& one) { return one.participant; });
    const auto fabrics = clustersOf(answers, [](const MatchAnswer& one) { return one.fabric; });
    const auto cells = clustersOf(answers, [](const MatchAnswer& one) { return std::pair(one.participant, one.fabric); });
    const Indices estimate = indicesOf(all);
    const Indices byParticipant = jackknifeVariances(all, participants);
    const Indices byFabric = jackknifeVariances(all, fabrics);
    const Indices byCell = jackknifeVariances(all, cells);
    result.dPrime =
        clustered(estimate.dPrime, {byParticipant.dPrime, byFabric.dPrime, byCell.dPrime}, participants.size(), fabrics.size());
    result.criterion = clustered(estimate.criterion, {byParticipant.criterion, byFabric.criterion, byCell.criterion},
                                 participants.size(), fabrics.size());
    result.seDPrime = std::sqrt(varianceOfZ(all.hits, all.same) + varianceOfZ(all.falseAlarms, all.different));
    return result;
}

}  // namespace stats
