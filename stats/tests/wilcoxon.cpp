#include "stats/tests/wilcoxon.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "stats/kernels/decimal_grid.h"
#include "stats/kernels/distributions.h"
#include "stats/kernels/ranks.h"
#include "stats/tests/contrast.h"
#include "stats/tests/signed_sums.h"

namespace stats {
namespace {

constexpr std::size_t mostWalsh = 5000;

/// Differences in whole units of the decimal grid, or as doubles; units per one turn them back into numbers.
struct PairedDifferences {
    std::vector<double> values;
    double unitsPerOne = 1;
};

/// Magnitudes of differences that only rounding tells apart, or apart from zero, become equal.
void makeTies(std::vector<double>& differences, const std::vector<double>& numbers)
{
    double size = 0;
    bool isExact = true;
    for (const double number : numbers) {
        size = std::max(size, std::fabs(number));
        isExact = isExact && number == std::trunc(number);
    }
    if (isExact) return;  // above 10^15 they have no grid, but are exact
    std::vector<double> magnitudes{0};
    for (const double difference : differences) magnitudes.push_back(std::fabs(difference));
    const std::vector<double> tied = withoutRounding(magnitudes, size);
    for (std::size_t i = 0; i < differences.size(); ++i) differences[i] = std::copysign(tied[i + 1], differences[i]);
}

PairedDifferences differencesOf(std::span<const double> x, std::span<const double> y, Arithmetic arithmetic)
{
    PairedDifferences differences;
    differences.values.resize(x.size());
    std::vector<double> both(x.begin(), x.end());
    both.insert(both.end(), y.begin(), y.end());
    const auto grid = arithmetic == Arithmetic::Decimal ? decimalGridOf(both) : std::nullopt;
    for (std::size_t i = 0; i < x.size(); ++i) {
        if (grid)
            differences.values[i] = static_cast<double>(grid->units[i] - (y.empty() ? 0 : grid->units[x.size() + i]));
        else
            differences.values[i] = x[i] - (y.empty() ? 0 : y[i]);
    }
    if (grid) differences.unitsPerOne = grid->unitsPerOne();
    if (!grid && arithmetic == Arithmetic::Decimal) makeTies(differences.values, both);
    return differences;
}

/// Doubled mid-ranks of the non-zero differences, and the sum of the ranks of the positive ones.
struct SignedRanks {
    std::vector<long long> doubled;
    long long positive = 0;
    long long total = 0;
};

SignedRanks signedRanksOf(const std::vector<double>& differences, ZeroMethod zeros)
{
    std::vector<double> magnitudes;
    std::vector<bool> isPositive;
    std::vector<bool> isZero;
    for (const double difference : differences) {
        if (difference == 0 && zeros == ZeroMethod::Wilcox) continue;
        magnitudes.push_back(std::fabs(difference));
        isPositive.push_back(difference > 0);
        isZero.push_back(difference == 0);
    }
    const MidRanks ranks = midRanks<double>(magnitudes);
    SignedRanks result;
    for (std::size_t i = 0; i < magnitudes.size(); ++i) {
        if (isZero[i]) continue;
        result.doubled.push_back(ranks.doubled[i]);
        result.total += ranks.doubled[i];
        if (isPositive[i]) result.positive += ranks.doubled[i];
    }
    return result;
}

void setExact(WilcoxonTest& test, const SignedRanks& ranks, Tail tail)
{
    if (!signedSumIsFeasible(ranks.doubled)) {
        test.pExact = test.logPExact = Value::undefined("more than 1000 differences: read the p of the normal approximation");
        return;
    }
    const TailProbability exact = signedSumProbability(ranks.doubled, ranks.positive, tail);
    test.pExact = exact.p;
    test.logPExact = exact.logP;
}

double normalP(double z, Tail tail)
{
    switch (tail) {
        case Tail::Less:
            return normalUpper(-z).p;
        case Tail::Greater:
            return normalUpper(z).p;
        case Tail::TwoSided:
            return std::min(1.0, 2 * normalUpper(std::fabs(z)).p);
    }
    return 1;
}

void setNormal(WilcoxonTest& test, const SignedRanks& ranks, Tail tail)
{
    double squares = 0;
    for (const long long rank : ranks.doubled) squares += static_cast<double>(rank) * static_cast<double>(rank);
    const double sd = std::sqrt(squares / 4) / 2;
    const double excess = static_cast<double>(2 * ranks.positive - ranks.total) / 4;
    double correction = 0;
    switch (tail) {
        case Tail::Less:
            correction = -0.5;
            break;
        case Tail::Greater:
            correction = 0.5;
            break;
        case Tail::TwoSided:
            correction = excess == 0 ? 0 : std::copysign(0.5, excess);
            break;
    }
    test.z = excess / sd;
    test.pNormal = normalP(*test.z, tail);
    test.zCorrected = (excess - correction) / sd;
    test.pNormalCorrected = normalP(*test.zCorrected, tail);
}

Value hodgesLehmannOf(const PairedDifferences& differences)
{
    const std::vector<double>& d = differences.values;
    if (d.size() > mostWalsh) return Value::undefined("more than 5000 differences");
    std::vector<double> sums;
    sums.reserve(d.size() * (d.size() + 1) / 2);
    for (std::size_t i = 0; i < d.size(); ++i)
        for (std::size_t j = i; j < d.size(); ++j) sums.push_back(d[i] / 2 + d[j] / 2);
    const auto middle = sums.begin() + static_cast<std::ptrdiff_t>(sums.size() / 2);
    std::nth_element(sums.begin(), middle, sums.end());
    double centre = *middle;
    if (sums.size() % 2 == 0) centre = centre / 2 + *std::max_element(sums.begin(), middle) / 2;
    return centre / differences.unitsPerOne;
}

void refuse(WilcoxonTest& test, const std::string& why)
{
    test.why = why;
    for (Value* value : {&test.v, &test.pExact, &test.logPExact, &test.z, &test.pNormal, &test.zCorrected, &test.pNormalCorrected,
                         &test.rankBiserial, &test.hodgesLehmann})
        *value = Value::undefined(why);
}

}  // namespace

WilcoxonTest wilcoxonSignedRank(std::span<const double> x, std::span<const double> y, const WilcoxonOptions& options)
{
    WilcoxonTest test;
    const TKind kind = y.empty() ? TKind::OneSample : TKind::Paired;
    if (const std::string fault = inputFault(kind, x, y); !fault.empty()) {
        refuse(test, fault);
        return test;
    }
    const PairedDifferences differences = differencesOf(x, y, options.arithmetic);
    if (const std::string fault = nonFiniteFault(differences.values, "the differences"); !fault.empty()) {
        refuse(test, fault);
        return test;
    }
    const SignedRanks ranks = signedRanksOf(differences.values, options.zeros);
    test.nUsed = ranks.doubled.size();
    test.nZero = x.size() - test.nUsed;
    if (test.nUsed == 0) {
        refuse(test, "all differences are zero");
        return test;
    }
    test.v = static_cast<double>(ranks.positive) / 2;
    setExact(test, ranks, options.tail);
    setNormal(test, ranks, options.tail);
    test.rankBiserial = static_cast<double>(2 * ranks.positive - ranks.total) / static_cast<double>(ranks.total);
    test.hodgesLehmann = hodgesLehmannOf(differences);
    return test;
}

}  // namespace stats
