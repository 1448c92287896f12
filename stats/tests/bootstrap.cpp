#include "stats/tests/bootstrap.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "stats/kernels/decimal_grid.h"
#include "stats/kernels/distributions.h"
#include "stats/kernels/draws.h"
#include "stats/kernels/exact_sum.h"
#include "stats/kernels/moments.h"
#include "stats/kernels/threads.h"

namespace stats {
namespace {

constexpr std::size_t blockOfResamples = 64;
constexpr std::size_t mostResamples = 100000000;

/// The sample in a form whose sums are exact where it lies on a decimal grid, and small where not.
struct Terms {
    std::vector<double> values;
    double observed = 0;  ///< sum of the values
    double noise = 0;     ///< sums this close to the observed one are ties
    double base = 0;      ///< mean = base + sum * factor
    double factor = 1;
};

/// In ascending order, so that the order of the sample changes no draw.
Terms termsOf(std::span<const double> x, std::span<const double> scaled, const Moments& moments)
{
    Terms terms;
    const auto n = static_cast<double>(x.size());
    if (const auto grid = decimalGridOf(x);
        grid && n * std::fabs(std::max(moments.largest, -moments.smallest)) * grid->unitsPerOne() < 9e15) {
        terms.values.assign(grid->units.begin(), grid->units.end());
        std::sort(terms.values.begin(), terms.values.end());
        for (const double value : terms.values) terms.observed += value;
        terms.factor = 1 / (grid->unitsPerOne() * n);
        return terms;
    }
    for (const double value : scaled) terms.values.push_back((value - moments.shift) - moments.residual);
    std::sort(terms.values.begin(), terms.values.end());
    for (const double value : terms.values) {
        terms.observed += value;
        terms.noise += 1e-15 * std::fabs(value);
    }
    terms.base = moments.mean();
    terms.factor = 1 / n;
    return terms;
}

/// Sum of as many values as there are, drawn with replacement; two draws from the halves of one number.
double resampledSum(const std::vector<double>& values, Draws& draws)
{
    const std::uint64_t n = values.size();
    double first = 0;
    double second = 0;
    for (std::size_t i = 0; i + 1 < values.size(); i += 2) {
        const std::uint64_t bits = draws.bits();
        first += values[((bits & 0xFFFFFFFFU) * n) >> 32U];
        second += values[((bits >> 32U) * n) >> 32U];
    }
    if (n % 2 == 1) first += values[((draws.bits() >> 32U) * n) >> 32U];
    return first + second;
}

std::vector<double> resampledSums(const std::vector<double>& values, const BootstrapOptions& options)
{
    std::vector<double> sums(options.resamples);
    const std::size_t blocks = (sums.size() + blockOfResamples - 1) / blockOfResamples;
    onThreads(blocks, options.threads, [&](std::size_t block) {
        Draws draws(options.seed, block);
        const std::size_t end = std::min(sums.size(), (block + 1) * blockOfResamples);
        for (std::size_t i = block * blockOfResamples; i < end; ++i) sums[i] = resampledSum(values, draws);
    });
    return sums;
}

/// Type-7 quantile without sorting everything.
double quantileOf(std::vector<double>& x, double probability)
{
    const double place = probability * static_cast<double>(x.size() - 1);
    const auto below = x.begin() + static_cast<std::ptrdiff_t>(std::floor(place));
    std::nth_element(x.begin(), below, x.end());
    const double share = place - std::floor(place);
    if (share == 0) return *below;
    return *below + share * (*std::min_element(below + 1, x.end()) - *below);
}

double accelerationOf(std::span<const double> scaled, const Moments& moments)
{
    const double cubes = orderFreeSum(scaled.size(), [&](std::size_t i) {
        const double deviation = (scaled[i] - moments.shift) - moments.residual;
        return deviation * deviation * deviation;
    });
    return cubes / (6 * moments.squares * std::sqrt(moments.squares));
}

/// Share of the resamples below the observed sum.
double shareBelow(const std::vector<double>& sums, const Terms& terms)
{
    double below = 0;
    for (const double sum : sums) {
        const double distance = sum - terms.observed;
        below += std::fabs(distance) <= terms.noise ? 0.5 : distance < 0 ? 1 : 0;
    }
    return below / static_cast<double>(sums.size());
}

std::string faultOf(std::span<const double> x, const BootstrapOptions& options)
{
    if (x.size() < 2) return x.empty() ? "there are no values" : "needs at least 2 values";
    if (std::string fault = nonFiniteFault(x, "x"); !fault.empty()) return fault;
    if (options.resamples == 0 || options.resamples > mostResamples) return "needs 1 to 100000000 resamples";
    if (!(options.confidence > 0 && options.confidence < 1)) return "the confidence must lie between 0 and 1";
    return {};
}

BcaBootstrap& refuse(BcaBootstrap& result, const std::string& why)
{
    result.why = why;
    for (Value* value :
         {&result.estimate, &result.standardError, &result.bias, &result.acceleration, &result.ci.low, &result.ci.high})
        if (!value->exists()) *value = Value::undefined(why);
    return result;
}

/// The two quantiles of the resampled sums that Efron's shift of the percentiles asks for.
Interval intervalOf(const BcaBootstrap& result, std::vector<double>& sums, double confidence, const auto& meanOfSum)
{
    const double bias = *result.bias;
    const auto bound = [&](double z) {
        const double stretched = 1 - *result.acceleration * (bias + z);
        if (!(stretched > 0)) return Value::undefined("the sample is too skewed for an interval of this confidence");
        return meanOfSum(quantileOf(sums, normalUpper(-(bias + (bias + z) / stretched)).p));
    };
    const double outside = normalQuantile((1 - confidence) / 2);
    return {bound(-outside), bound(outside)};
}

}  // namespace

BcaBootstrap bcaBootstrapOfMean(std::span<const double> x, const BootstrapOptions& options)
{
    BcaBootstrap result;
    result.n = x.size();
    if (const std::string fault = faultOf(x, options); !fault.empty()) return refuse(result, fault);
    const ScaledSamples scaled({x});
    const Moments moments = momentsOf(scaled.sample(0));
    result.estimate = scaled.unscaled(moments.mean());
    if (isConstant(moments)) return refuse(result, "no variation: all values are equal");
    const Terms terms = termsOf(x, scaled.sample(0), moments);
    std::vector<double> sums = resampledSums(terms.values, options);
    const double below = shareBelow(sums, terms);
    result.acceleration = accelerationOf(scaled.sample(0), moments);
    if (!(below > 0 && below < 1)) return refuse(result, "all resampled means lie on one side of the mean");
    result.bias = -normalQuantile(below);
    result.standardError = scaled.unscaled(std::sqrt(momentsOf(sums).squares / static_cast<double>(sums.size())) * terms.factor);
    result.ci = intervalOf(result, sums, options.confidence,
                           [&](double sum) { return scaled.unscaled(terms.base + sum * terms.factor); });
    if (!result.ci.low.exists() && result.ci.low.decimal().empty()) result.why = result.ci.low.why();
    if (!result.ci.high.exists() && result.ci.high.decimal().empty()) result.why = result.ci.high.why();
    return result;
}

}  // namespace stats
