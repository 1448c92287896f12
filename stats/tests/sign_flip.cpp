#include "stats/tests/sign_flip.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "stats/kernels/decimal_grid.h"
#include "stats/kernels/distributions.h"
#include "stats/tests/contrast.h"
#include "stats/tests/signed_sums.h"

namespace stats {
namespace {

constexpr std::size_t mostEnumerated = 22;

SignFlipTest& refuse(SignFlipTest& test, const std::string& why)
{
    test.why = why;
    for (Value* value : {&test.meanDifference, &test.p, &test.logP})
        if (!value->exists()) *value = Value::undefined(why);
    return test;
}

bool isAtLeastAsFar(double sum, double observed, double noise, Tail tail)
{
    switch (tail) {
        case Tail::Greater:
            return sum >= observed - noise;
        case Tail::Less:
            return sum <= observed + noise;
        case Tail::TwoSided:
            return std::fabs(sum) >= std::fabs(observed) - noise;
    }
    return false;
}

/// p from all 2^n signs, one by one. A sum that equals the observed one up to rounding counts as equal.
double enumerated(const std::vector<double>& differences, Tail tail)
{
    double observed = 0;
    double magnitude = 0;
    for (const double difference : differences) {
        observed += difference;
        magnitude += std::fabs(difference);
    }
    const double noise = 1e-14 * magnitude;
    const std::size_t all = std::size_t{1} << differences.size();
    std::size_t far = 0;
    for (std::size_t signs = 0; signs < all; ++signs) {
        double sum = 0;
        for (std::size_t i = 0; i < differences.size(); ++i) sum += (signs >> i & 1U) != 0 ? differences[i] : -differences[i];
        if (isAtLeastAsFar(sum, observed, noise, tail)) ++far;
    }
    return static_cast<double>(far) / static_cast<double>(all);
}

SignFlipTest ofUnits(SignFlipTest test, const std::vector<long long>& units, double unitsPerOne, Tail tail)
{
    std::vector<long long> magnitudes;
    long long positive = 0;
    double sum = 0;
    for (const long long unit : units) {
        sum += static_cast<double>(unit);
        if (unit == 0) continue;
        magnitudes.push_back(std::llabs(unit));
        positive += std::max(unit, 0LL);
    }
    test.nZero = units.size() - magnitudes.size();
    test.meanDifference = sum / (unitsPerOne * static_cast<double>(units.size()));
    if (magnitudes.empty()) return refuse(test, "all differences are zero");
    if (!signedSumIsFeasible(magnitudes))
        return refuse(test, "too many differences, or on too fine a grid, to go through all signs");
    const TailProbability tailProbability = signedSumProbability(magnitudes, positive, tail);
    test.p = tailProbability.p;
    test.logP = tailProbability.logP;
    return test;
}

SignFlipTest withoutGrid(SignFlipTest test, std::span<const double> x, std::span<const double> y, Tail tail)
{
    const ScaledSamples scaled({x, y});
    std::vector<double> differences(x.size());
    for (std::size_t i = 0; i < x.size(); ++i) differences[i] = scaled.sample(0)[i] - (y.empty() ? 0 : scaled.sample(1)[i]);
    test.meanDifference = scaled.unscaled(momentsOf(differences).mean());
    test.nZero = static_cast<std::size_t>(std::count(differences.begin(), differences.end(), 0.0));
    std::erase(differences, 0.0);
    if (differences.empty()) return refuse(test, "all differences are zero");
    if (differences.size() > mostEnumerated)
        return refuse(test, "the data lie on no decimal grid, and there are too many to go through all signs");
    test.p = enumerated(differences, tail);
    test.logP = std::log(*test.p);
    return test;
}

}  // namespace

SignFlipTest signFlipTest(std::span<const double> x, std::span<const double> y, Tail tail)
{
    SignFlipTest test;
    test.n = x.size();
    if (const std::string fault = inputFault(y.empty() ? TKind::OneSample : TKind::Paired, x, y); !fault.empty())
        return refuse(test, fault);
    std::vector<double> both(x.begin(), x.end());
    both.insert(both.end(), y.begin(), y.end());
    const auto grid = decimalGridOf(both);
    if (!grid) return withoutGrid(test, x, y, tail);
    std::vector<long long> units(x.size());
    for (std::size_t i = 0; i < x.size(); ++i) units[i] = grid->units[i] - (y.empty() ? 0 : grid->units[x.size() + i]);
    return ofUnits(test, units, grid->unitsPerOne(), tail);
}

}  // namespace stats
