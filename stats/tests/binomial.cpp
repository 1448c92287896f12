#include "stats/tests/binomial.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "stats/kernels/distributions.h"

namespace stats {
namespace {

double atLeast(long long k, long long n, double chance)
{
    if (k <= 0) return 1;
    return k > n ? 0 : betaLower(static_cast<double>(k), static_cast<double>(n - k + 1), chance);
}

double atMost(long long k, long long n, double chance)
{
    if (k >= n) return 1;
    return k < 0 ? 0 : betaUpper(static_cast<double>(k + 1), static_cast<double>(n - k), chance);
}

double logProbability(long long k, long long n, double chance)
{
    const auto kk = static_cast<double>(k);
    const auto nn = static_cast<double>(n);
    return std::lgamma(nn + 1) - std::lgamma(kk + 1) - std::lgamma(nn - kk + 1) + kk * std::log(chance) +
           (nn - kk) * std::log1p(-chance);
}

/// log P(X >= k) for k above the mean: the largest term, and the ratios of the terms after it.
double logAtLeast(long long k, long long n, double chance)
{
    const double odds = chance / (1 - chance);
    double term = 1;
    double series = 1;
    for (long long i = k; i < n && term > series * 1e-17; ++i) {
        term *= static_cast<double>(n - i) / static_cast<double>(i + 1) * odds;
        series += term;
    }
    return logProbability(k, n, chance) + std::log(series);
}

/// Bisection: the first i of first ... last for which a monotone condition holds; last + 1 where none does.
template <typename Condition>
long long firstWhere(long long first, long long last, Condition holds)
{
    while (first <= last) {
        const long long middle = first + (last - first) / 2;
        if (holds(middle))
            last = middle - 1;
        else
            first = middle + 1;
    }
    return first;
}

/// The two tails of the two-sided p.
struct BothTails {
    long long atMost = -1;  ///< the lower tail ends here; empty below 0
    long long atLeast = 0;  ///< the upper tail begins here
};

/// Counts as likely as the observed one up to rounding belong to the tails.
BothTails bothTails(long long k, long long n, double chance)
{
    const double mean = static_cast<double>(n) * chance;
    const double limit = logProbability(k, n, chance) + 1e-7;
    const auto asUnlikely = [&](long long i) { return logProbability(i, n, chance) <= limit; };
    // Probabilities decrease on both sides of the mean.
    if (static_cast<double>(k) < mean) {
        const long long other = firstWhere(static_cast<long long>(std::ceil(mean)), n, asUnlikely);
        return {k, std::max(other, k + 1)};
    }
    const auto below = static_cast<long long>(std::floor(mean));
    const long long other = below - firstWhere(0, below, [&](long long distance) { return asUnlikely(below - distance); });
    return {std::min(other, k - 1), k};
}

/// log P(X >= k), from the tail that keeps its digits.
double logGreater(long long k, long long n, double chance)
{
    const double greater = atLeast(k, n, chance);
    if (greater > 0.5) return std::log1p(-atMost(k - 1, n, chance));
    if (k > n) return -std::numeric_limits<double>::infinity();
    return greater > 1e-280 ? std::log(greater) : logAtLeast(k, n, chance);
}

double logLess(long long k, long long n, double chance) { return logGreater(n - k, n, 1 - chance); }

/// log(e^a + e^b)
double logSum(double a, double b)
{
    const double larger = std::max(a, b);
    return std::isinf(larger) ? larger : larger + std::log(std::exp(a - larger) + std::exp(b - larger));
}

double logTwoSided(const BothTails& tails, long long n, double chance, double p)
{
    if (p > 1e-280) return std::log(p);
    return logSum(tails.atMost < 0 ? -std::numeric_limits<double>::infinity() : logLess(tails.atMost, n, chance),
                  logGreater(tails.atLeast, n, chance));
}

std::string countsFault(long long successes, long long trials)
{
    if (trials <= 0) return "there are no trials";
    if (successes < 0) return "a count cannot be negative";
    if (successes > trials) return "more successes than trials";
    return {};
}

void refuse(BinomialTest& test, const std::string& why)
{
    test.why = why;
    for (Value* value :
         {&test.estimate, &test.pGreater, &test.logPGreater, &test.pLess, &test.pTwoSided, &test.pMidGreater, &test.logPTwoSided,
          &test.logPMidGreater, &test.clopperPearson.low, &test.clopperPearson.high, &test.wilson.low, &test.wilson.high})
        *value = Value::undefined(why);
}

Interval undefinedInterval(const std::string& why) { return {Value::undefined(why), Value::undefined(why)}; }

}  // namespace

Interval wilsonInterval(long long successes, long long trials, double confidence)
{
    if (const std::string fault = countsFault(successes, trials); !fault.empty()) return undefinedInterval(fault);
    const auto n = static_cast<double>(trials);
    const double share = static_cast<double>(successes) / n;
    const double z = normalQuantile((1 - confidence) / 2);
    const double centre = share + z * z / (2 * n);
    const double margin = z * std::sqrt(share * (1 - share) / n + z * z / (4 * n * n));
    const double whole = 1 + z * z / n;
    return {successes == 0 ? 0.0 : (centre - margin) / whole, successes == trials ? 1.0 : (centre + margin) / whole};
}

Interval clopperPearsonInterval(long long successes, long long trials, double confidence)
{
    if (const std::string fault = countsFault(successes, trials); !fault.empty()) return undefinedInterval(fault);
    const auto k = static_cast<double>(successes);
    const auto n = static_cast<double>(trials);
    const double outside = (1 - confidence) / 2;
    return {successes == 0 ? 0.0 : betaQuantile(k, n - k + 1, outside),
            successes == trials ? 1.0 : betaQuantile(k + 1, n - k, 1 - outside)};
}

BinomialTest binomialTest(long long successes, long long trials, double chance, double confidence)
{
    BinomialTest test;
    std::string fault = countsFault(successes, trials);
    if (fault.empty() && !(chance > 0 && chance < 1)) fault = "the chance level must lie between 0 and 1";
    if (!fault.empty()) {
        refuse(test, fault);
        return test;
    }
    test.estimate = static_cast<double>(successes) / static_cast<double>(trials);
    const double greater = atLeast(successes, trials, chance);
    test.pGreater = greater;
    test.logPGreater = logGreater(successes, trials, chance);
    test.pLess = atMost(successes, trials, chance);
    const BothTails tails = bothTails(successes, trials, chance);
    test.pTwoSided = std::min(1.0, atMost(tails.atMost, trials, chance) + atLeast(tails.atLeast, trials, chance));
    test.logPTwoSided = logTwoSided(tails, trials, chance, *test.pTwoSided);
    test.pMidGreater = (greater + atLeast(successes + 1, trials, chance)) / 2;
    test.logPMidGreater = *test.pMidGreater > 1e-280
                              ? std::log(*test.pMidGreater)
                              : logSum(*test.logPGreater, logGreater(successes + 1, trials, chance)) - std::numbers::ln2;
    test.clopperPearson = clopperPearsonInterval(successes, trials, confidence);
    test.wilson = wilsonInterval(successes, trials, confidence);
    return test;
}

}  // namespace stats
