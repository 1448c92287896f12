#include "stats/kernels/block_sums.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "stats/kernels/vector_clones.h"

namespace stats {
namespace {

constexpr std::size_t lanes = 4;
constexpr std::size_t stride = 2 * lanes;
using Four = double __attribute__((vector_size(lanes * sizeof(double))));

// By reference: a vector register as an argument would depend on the instruction set.
[[gnu::always_inline]] inline void load(const double* from, Four& to) { std::memcpy(&to, from, sizeof to); }

[[gnu::always_inline]] inline double total(const Four& x) { return (x[0] + x[1]) + (x[2] + x[3]); }

[[gnu::always_inline]] inline double smallestOf(const Four& x) { return std::min(std::min(x[0], x[1]), std::min(x[2], x[3])); }

[[gnu::always_inline]] inline double largestOf(const Four& x) { return std::max(std::max(x[0], x[1]), std::max(x[2], x[3])); }

[[gnu::always_inline]] inline double sumAndExtremes(const double* x, std::size_t n, BlockSums& sums)
{
    const std::size_t whole = n - n % stride;
    Four a;
    Four b;
    Four sumA{};
    Four sumB{};
    Four low = Four{} + x[0];
    Four high = low;
    for (std::size_t i = 0; i < whole; i += stride) {
        load(x + i, a);
        load(x + i + lanes, b);
        sumA += a;
        sumB += b;
        const Four lower = a < b ? a : b;
        const Four upper = a < b ? b : a;
        low = lower < low ? lower : low;
        high = upper > high ? upper : high;
    }
    sums.smallest = smallestOf(low);
    sums.largest = largestOf(high);
    sumA += sumB;
    double sum = total(sumA);
    for (std::size_t i = whole; i < n; ++i) {
        sum += x[i];
        sums.smallest = std::min(sums.smallest, x[i]);
        sums.largest = std::max(sums.largest, x[i]);
    }
    return sum;
}

[[gnu::always_inline]] inline void sumsAbout(double mean, const double* x, std::size_t n, BlockSums& sums)
{
    const std::size_t whole = n - n % stride;
    Four a;
    Four b;
    Four residualA{};
    Four residualB{};
    Four squaresA{};
    Four squaresB{};
    for (std::size_t i = 0; i < whole; i += stride) {
        load(x + i, a);
        load(x + i + lanes, b);
        a -= mean;
        b -= mean;
        residualA += a;
        residualB += b;
        squaresA += a * a;
        squaresB += b * b;
    }
    residualA += residualB;
    squaresA += squaresB;
    sums.residual = total(residualA);
    sums.squares = total(squaresA);
    for (std::size_t i = whole; i < n; ++i) {
        const double deviation = x[i] - mean;
        sums.residual += deviation;
        sums.squares += deviation * deviation;
    }
}

}  // namespace

STATS_VECTOR_CLONES void blockSums(const double* x, std::size_t n, BlockSums& sums)
{
    sums.mean = sumAndExtremes(x, n, sums) / static_cast<double>(n);
    sumsAbout(sums.mean, x, n, sums);
}

STATS_VECTOR_CLONES void subtract(const double* x, const double* y, double* differences, std::size_t n)
{
    for (std::size_t i = 0; i < n; ++i) differences[i] = x[i] - y[i];
}

STATS_VECTOR_CLONES double sumOfMagnitudes(const double* x, std::size_t n)
{
    double sums[stride] = {};
    const std::size_t whole = n - n % stride;
    for (std::size_t i = 0; i < whole; i += stride)
        for (std::size_t lane = 0; lane < stride; ++lane) sums[lane] += std::fabs(x[i + lane]);
    double sum = 0;
    for (const double one : sums) sum += one;
    for (std::size_t i = whole; i < n; ++i) sum += std::fabs(x[i]);
    return sum;
}

}  // namespace stats
