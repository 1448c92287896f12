#include "stats/power/two_condition_model.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

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
struct Stratum {
    double squares, degrees, weight;
    int above;  ///< the stratum whose expected mean square cannot be larger; -1: none

    double meanSquare() const { return squares / degrees; }
};

enum StratumPlace : int { Residual, ParticipantDifference, FabricDifference, ParticipantSum, FabricSum };

/// Pools the smallest mean square with the one above it until none is below.
template <std::size_t Count>
void poolNegativeVariances(std::array<Stratum, Count>& strata)
{
    std::array<bool, Count> isPooled{};
    while (true) {
        int least = -1;
        for (int k = 1; k < static_cast<int>(Count); ++k) {
            const auto at = static_cast<std::size_t>(k);
            if (isPooled[at]) continue;
            if (strata[at].meanSquare() >= strata[static_cast<std::size_t>(strata[at].above)].meanSquare()) continue;
            if (least < 0 || strata[at].meanSquare() < strata[static_cast<std::size_t>(least)].meanSquare()) least = k;
        }
        if (least < 0) return;
        Stratum& pooled = strata[static_cast<std::size_t>(least)];
        Stratum& into = strata[static_cast<std::size_t>(pooled.above)];
        into.squares += pooled.squares;
        into.degrees += pooled.degrees;
        into.weight += pooled.weight;
        pooled.weight = 0;
        isPooled[static_cast<std::size_t>(least)] = true;
        for (Stratum& stratum : strata)
            if (stratum.above == least) stratum.above = pooled.above;
    }
}

}  // namespace

CrossedMean differenceByTwoConditionModel(const CrossedTable& a, const CrossedTable& b, StudentQuantiles& quantiles)
{
    assert(a.participants == b.participants && a.fabrics == b.fabrics && a.participants > 1 && a.fabrics > 1);
    CrossedTable difference = a, sum = a;
    for (std::size_t cell = 0; cell < a.values.size(); ++cell) {
        difference.values[cell] -= b.values[cell];
        sum.values[cell] += b.values[cell];
    }
    const SquaresOfTable ofDifference = squaresOfTable(difference), ofSum = squaresOfTable(sum);
    const auto p = static_cast<double>(a.participants), f = static_cast<double>(a.fabrics);
    const double crossed = (p - 1) * (f - 1);
    std::array<Stratum, 5> strata{
        Stratum{ofDifference.residual + ofSum.residual, 2 * crossed, -1, -1},
        Stratum{ofDifference.participant, p - 1, 1, Residual}, Stratum{ofDifference.fabric, f - 1, 1, Residual},
        Stratum{ofSum.participant, p - 1, 0, ParticipantDifference}, Stratum{ofSum.fabric, f - 1, 0, FabricDifference}};
    poolNegativeVariances(strata);
    double variance = 0, uncertainty = 0;
    for (const Stratum& stratum : strata) {
        const double part = stratum.weight * stratum.meanSquare();
        variance += part;
        uncertainty += part * part / stratum.degrees;
    }
    ContrastTest test;
    test.estimate = ofDifference.mean;
    const bool isKnown = variance > 0;
    test.se = isKnown ? Value(std::sqrt(variance / (p * f))) : Value::undefined("the differences do not vary");
    test.df = isKnown ? Value(variance * variance / uncertainty) : Value::undefined("the differences do not vary");
    CrossedMean mean = crossedMean(test, quantiles);
    mean.values = difference.values.size();
    mean.participants = a.participants;
    mean.fabrics = a.fabrics;
    return mean;
}

}  // namespace stats
