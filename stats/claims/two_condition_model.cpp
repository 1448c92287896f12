#include "stats/claims/two_condition_model.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "stats/models/mixed_model_fit.h"

namespace stats {
namespace {

/// Mean squares of one table of participants x fabrics.
struct SquaresOfTable {
    double mean = 0, participant = 0, fabric = 0, residual = 0;  // sums of squares, but for the mean
};

SquaresOfTable squaresOfTable(const CrossedTable& table)
{
    SquaresOfTable result;
    const auto p = static_cast<double>(table.participants), f = static_cast<double>(table.fabrics);
    for (const double value : table.values) result.mean += value / (p * f);
    std::vector<double> ofParticipant(table.participants, -result.mean), ofFabric(table.fabrics, -result.mean);
    for (std::size_t cell = 0; cell < table.values.size(); ++cell) {
        ofParticipant[cell / table.fabrics] += table.values[cell] / f;
        ofFabric[cell % table.fabrics] += table.values[cell] / p;
    }
    for (const double effect : ofParticipant) result.participant += f * effect * effect;
    for (const double effect : ofFabric) result.fabric += p * effect * effect;
    for (std::size_t cell = 0; cell < table.values.size(); ++cell) {
        const double rest =
            table.values[cell] - result.mean - ofParticipant[cell / table.fabrics] - ofFabric[cell % table.fabrics];
        result.residual += rest * rest;
    }
    return result;
}

/// Sums of squares with one expected mean square. `weight`: its part in the variance of the difference.
struct PairStratum {
    double squares, degrees, weight;
    int above;  ///< the stratum whose expected mean square cannot be larger; -1: none

    double meanSquare() const { return squares / degrees; }
};

enum StratumPlace : int { Residual, ParticipantDifference, FabricDifference, ParticipantSum, FabricSum };

/// Pools the smallest mean square with the one above it until none is below. A tie counts as below, as lmer puts it at zero.
template <std::size_t Count>
void poolNegativeVariances(std::array<PairStratum, Count>& strata)
{
    std::array<bool, Count> isPooled{};
    while (true) {
        int least = -1;
        for (int k = 1; k < static_cast<int>(Count); ++k) {
            const auto at = static_cast<std::size_t>(k);
            if (isPooled[at]) continue;
            const double above = strata[static_cast<std::size_t>(strata[at].above)].meanSquare();
            if (strata[at].meanSquare() > above * (1 + tieShare)) continue;
            if (least < 0 || strata[at].meanSquare() < strata[static_cast<std::size_t>(least)].meanSquare()) least = k;
        }
        if (least < 0) return;
        PairStratum& pooled = strata[static_cast<std::size_t>(least)];
        PairStratum& into = strata[static_cast<std::size_t>(pooled.above)];
        into.squares += pooled.squares;
        into.degrees += pooled.degrees;
        into.weight += pooled.weight;
        pooled.weight = 0;
        isPooled[static_cast<std::size_t>(least)] = true;
        for (PairStratum& stratum : strata)
            if (stratum.above == least) stratum.above = pooled.above;
    }
}

/// Largest difference, as a share of their size, of ratings or means of ratings that are equal but for rounding.
constexpr double roundingOfRatings = 1e-14;

/// Both tables without the participants and fabrics that lack an answer under a condition everywhere.
struct Pair {
    CrossedTable a, b;
};

Pair present(const CrossedTable& a, const CrossedTable& b)
{
    std::vector<bool> participantMet(a.participants), fabricMet(a.fabrics);
    for (std::size_t cell = 0; cell < a.values.size(); ++cell)
        if (!std::isnan(a.values[cell] - b.values[cell])) participantMet[cell / a.fabrics] = fabricMet[cell % a.fabrics] = true;
    const auto count = [](const std::vector<bool>& met) { return static_cast<std::size_t>(std::ranges::count(met, true)); };
    Pair pair{{count(participantMet), count(fabricMet), {}}, {count(participantMet), count(fabricMet), {}}};
    for (std::size_t cell = 0; cell < a.values.size(); ++cell) {
        if (!participantMet[cell / a.fabrics] || !fabricMet[cell % a.fabrics]) continue;
        pair.a.values.push_back(a.values[cell]);
        pair.b.values.push_back(b.values[cell]);
    }
    return pair;
}

bool isComplete(const CrossedTable& table)
{
    return std::ranges::none_of(table.values, [](double value) { return std::isnan(value); });
}

/// Ratings that are all equal; means of equal repetitions may differ in the last digit.
bool hasEqualRatings(const CrossedTable& table)
{
    if (table.values.empty()) return true;
    const auto [least, most] = std::ranges::minmax(table.values);
    return most - least <= roundingOfRatings * std::max(std::fabs(least), std::fabs(most));
}

/// Sums of the two tables about the means of each, and the differences; divided by a power of 2 so that squares stay in range.
struct ScaledPair {
    CrossedTable difference, sum;
    int exponent = 0;
};

double meanOfTable(const CrossedTable& table)
{
    double mean = 0;
    for (const double value : table.values) mean += value / static_cast<double>(table.values.size());
    return mean;
}

ScaledPair scaled(const CrossedTable& a, const CrossedTable& b)
{
    ScaledPair pair{a, a, 0};
    const double meanA = meanOfTable(a), meanB = meanOfTable(b);
    double largest = 0;
    for (std::size_t cell = 0; cell < a.values.size(); ++cell) {
        pair.difference.values[cell] = a.values[cell] - b.values[cell];
        pair.sum.values[cell] = (a.values[cell] - meanA) + (b.values[cell] - meanB);
        largest =
            std::max({largest, std::fabs(pair.difference.values[cell] - (meanA - meanB)), std::fabs(pair.sum.values[cell])});
    }
    pair.exponent = std::ilogb(largest);
    for (CrossedTable* table : {&pair.difference, &pair.sum})
        for (double& value : table->values) value = std::ldexp(value, -pair.exponent);
    return pair;
}

/// What the model says of the mean difference.
struct TwoConditionFit {
    double se = 0, df = 0;
    bool isSingular = false;  ///< the differences do not vary with participants, or not with fabrics
    bool noneVaries = false;  ///< with neither
};

TwoConditionFit fitOf(const CrossedTable& a, const CrossedTable& b)
{
    const ScaledPair pair = scaled(a, b);
    const SquaresOfTable ofDifference = squaresOfTable(pair.difference), ofSum = squaresOfTable(pair.sum);
    const auto p = static_cast<double>(a.participants), f = static_cast<double>(a.fabrics);
    const double crossed = (p - 1) * (f - 1);
    std::array<PairStratum, 5> strata{
        PairStratum{ofDifference.residual + ofSum.residual, 2 * crossed, -1, -1},
        PairStratum{ofDifference.participant, p - 1, 1, Residual}, PairStratum{ofDifference.fabric, f - 1, 1, Residual},
        PairStratum{ofSum.participant, p - 1, 0, ParticipantDifference}, PairStratum{ofSum.fabric, f - 1, 0, FabricDifference}};
    poolNegativeVariances(strata);
    double variance = 0, uncertainty = 0;
    for (const PairStratum& stratum : strata) {
        const double part = stratum.weight * stratum.meanSquare();
        variance += part;
        uncertainty += part * part / stratum.degrees;
    }
    TwoConditionFit fit;
    fit.se = std::ldexp(std::sqrt(variance / (p * f)), pair.exponent);
    fit.df = variance * variance / uncertainty;
    fit.isSingular = strata[ParticipantDifference].weight == 0 || strata[FabricDifference].weight == 0;
    fit.noneVaries = strata[ParticipantDifference].weight == 0 && strata[FabricDifference].weight == 0;
    return fit;
}

CrossedMean differenceOfComplete(const CrossedTable& a, const CrossedTable& b, Degrees degrees, StudentQuantiles& quantiles)
{
    const CrossedTable difference = evenDifferences(a, b);
    const CrossedMean ofDifferences = crossedMean(difference, Generalisation::FabricsLikeThese, quantiles);
    if (!ofDifferences.why.empty()) return ofDifferences;
    const TwoConditionFit fit = fitOf(a, b);
    if (!std::isfinite(fit.se) || !(fit.se > 0) || !(fit.df > 0)) return ofDifferences;
    const bool isLimited = fit.noneVaries && degrees == Degrees::Limited;
    ContrastTest test;
    test.estimate = ofDifferences.estimate;
    test.se = fit.se;
    test.df = isLimited ? std::min(fit.df, mostDegrees(difference)) : fit.df;
    CrossedMean mean = crossedMean(test, quantiles);
    mean.values = ofDifferences.values;
    mean.participants = ofDifferences.participants;
    mean.fabrics = ofDifferences.fabrics;
    mean.singular = fit.isSingular;
    return mean;
}

}  // namespace

CrossedTable evenDifferences(const CrossedTable& a, const CrossedTable& b)
{
    CrossedTable table = a;
    double least = INFINITY, most = -INFINITY, largest = 0;
    for (std::size_t cell = 0; cell < table.values.size(); ++cell) {
        table.values[cell] -= b.values[cell];
        if (std::isnan(table.values[cell])) continue;
        least = std::min(least, table.values[cell]);
        most = std::max(most, table.values[cell]);
        largest = std::max({largest, std::fabs(a.values[cell]), std::fabs(b.values[cell])});
    }
    if (most - least <= roundingOfRatings * largest)
        for (double& value : table.values)
            if (!std::isnan(value)) value = least;
    return table;
}

CrossedMean differenceByTwoConditionModel(const CrossedTable& a, const CrossedTable& b, StudentQuantiles& quantiles)
{
    assert(a.participants == b.participants && a.fabrics == b.fabrics && a.participants > 1 && a.fabrics > 1);
    return differenceOfComplete(a, b, Degrees::Satterthwaite, quantiles);
}

CrossedMean differenceOfRatings(const CrossedTable& a, const CrossedTable& b, Generalisation generalisation, Degrees degrees,
                                StudentQuantiles& quantiles)
{
    assert(a.participants == b.participants && a.fabrics == b.fabrics);
    const Pair pair = present(a, b);
    const CrossedTable differences = evenDifferences(pair.a, pair.b);
    const bool isModelled = generalisation == Generalisation::FabricsLikeThese && isComplete(differences) &&
                            !hasEqualRatings(pair.a) && !hasEqualRatings(pair.b);
    if (isModelled) return differenceOfComplete(pair.a, pair.b, degrees, quantiles);
    return crossedMean(differences, generalisation, quantiles, degrees);
}

}  // namespace stats
