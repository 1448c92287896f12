#include "stats/tests/signed_sums.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "stats/kernels/exact_sum.h"
#include "stats/kernels/vector_clones.h"

namespace stats {
namespace {

long long commonDivisor(std::span<const long long> magnitudes)
{
    long long divisor = 0;
    for (const long long one : magnitudes) divisor = std::gcd(divisor, one);
    return std::max(divisor, 1LL);
}

/// next[s] = (now[s] + now[s - step])/2 for 0 <= s < end, where now[s - step] is 0 for s < step.
STATS_VECTOR_CLONES void addTerm(const double* now, double* next, std::size_t step, std::size_t end)
{
    for (std::size_t s = 0; s < std::min(step, end); ++s) next[s] = 0.5 * now[s];
    for (std::size_t s = step; s < end; ++s) next[s] = 0.5 * now[s] + 0.5 * now[s - step];
}

/// Probabilities of the sums 0 ... total.
std::vector<double> distributionOf(std::span<const long long> terms)
{
    const auto total = static_cast<std::size_t>(std::accumulate(terms.begin(), terms.end(), 0LL));
    std::vector<double> now(total + 1, 0.0);
    std::vector<double> next(total + 1, 0.0);
    now[0] = 1;
    std::size_t reached = 0;
    for (const long long term : terms) {
        reached += static_cast<std::size_t>(term);
        addTerm(now.data(), next.data(), static_cast<std::size_t>(term), reached + 1);
        now.swap(next);
    }
    return now;
}

/// Probability of first <= s < end; 0 where that is empty.
double sumBetween(const std::vector<double>& probability, long long first, long long end)
{
    if (end <= first) return 0;
    const auto begin = static_cast<std::size_t>(first);
    return exactSum(static_cast<std::size_t>(end - first), [&](std::size_t i) { return probability[begin + i]; });
}

}  // namespace

bool signedSumIsFeasible(std::span<const long long> magnitudes)
{
    double sum = 0;
    for (const long long one : magnitudes) sum += static_cast<double>(one);
    return magnitudes.size() <= mostSignedTerms &&
           sum / static_cast<double>(commonDivisor(magnitudes)) * static_cast<double>(magnitudes.size()) <= mostSignedWork;
}

TailProbability signedSumProbability(std::span<const long long> magnitudes, long long positive, Tail tail)
{
    const long long divisor = commonDivisor(magnitudes);
    std::vector<long long> terms(magnitudes.begin(), magnitudes.end());
    for (long long& term : terms) term /= divisor;
    const std::vector<double> probability = distributionOf(terms);
    const long long total = static_cast<long long>(probability.size()) - 1;
    const long long end = total + 1;
    // The distribution is symmetric about total/2, so that the lower tail of v is the upper tail of total - v. The
    // smaller side is summed, so that 1 - p keeps its digits.
    const long long v = tail == Tail::Less ? total - positive / divisor : positive / divisor;
    if (tail != Tail::TwoSided) {
        const double p = sumBetween(probability, v, end);
        return p <= 0.5 ? TailProbability{p, std::log(p)} : complementOf({sumBetween(probability, 0, v), 0});
    }
    const long long outer = std::max(v, total - v);
    const double p = 2 * sumBetween(probability, outer, end);
    return p <= 0.5 ? TailProbability{p, std::log(p)} : complementOf({sumBetween(probability, total - outer + 1, outer), 0});
}

}  // namespace stats
