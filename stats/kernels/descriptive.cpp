#include "stats/kernels/descriptive.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "stats/kernels/distributions.h"
#include "stats/kernels/exact_sum.h"
#include "stats/kernels/moments.h"

namespace stats {
namespace {

void setAll(Description& description, const std::string& why)
{
    for (Value* value :
         {&description.mean, &description.sd, &description.variance, &description.autocorrelationLag1, &description.median,
          &description.q1, &description.q3, &description.min, &description.max, &description.ci95.low, &description.ci95.high})
        *value = Value::undefined(why);
}

void setSpread(Description& description, const std::string& why)
{
    for (Value* value : {&description.sd, &description.variance, &description.autocorrelationLag1, &description.ci95.low,
                         &description.ci95.high})
        *value = Value::undefined(why);
}

Value lagOne(std::span<const double> x, const Moments& moments)
{
    if (moments.squares == 0) return Value::undefined("all values are equal");
    const auto deviation = [&](std::size_t i) { return (x[i] - moments.shift) - moments.residual; };
    return exactSum(x.size() - 1, [&](std::size_t i) { return deviation(i) * deviation(i + 1); }) / moments.squares;
}

void describeOrder(Description& description, std::vector<double> x)
{
    std::sort(x.begin(), x.end());
    description.min = x.front();
    description.max = x.back();
    description.q1 = quantile(x, 0.25);
    description.median = quantile(x, 0.5);
    description.q3 = quantile(x, 0.75);
}

}  // namespace

Description describe(std::span<const double> values)
{
    Description description;
    std::vector<double> x;
    x.reserve(values.size());
    std::copy_if(values.begin(), values.end(), std::back_inserter(x), [](double value) { return !std::isnan(value); });
    description.n = x.size();
    description.missing = values.size() - x.size();
    if (x.empty()) {
        setAll(description, "there are no values");
        return description;
    }
    if (const std::string fault = nonFiniteFault(x, "the sample"); !fault.empty()) {
        setAll(description, fault);
        return description;
    }
    describeOrder(description, x);
    const ScaledSamples scaled({x});
    const Moments moments = momentsOf(scaled.sample(0));
    description.mean = scaled.unscaled(moments.mean());
    if (x.size() < 2) {
        setSpread(description, "needs at least 2 values");
        return description;
    }
    const double sd = std::sqrt(moments.variance());
    const double margin =
        studentQuantile(0.025, static_cast<double>(x.size() - 1)) * sd / std::sqrt(static_cast<double>(x.size()));
    description.sd = scaled.unscaled(sd);
    description.autocorrelationLag1 = lagOne(scaled.sample(0), moments);
    description.ci95 = {scaled.unscaled(moments.shift + (moments.residual - margin)),
                        scaled.unscaled(moments.shift + (moments.residual + margin))};
    if (isConstantButForRounding(moments, scaled.sample(0), scaled.exponent()))
        description.ci95.low = description.ci95.high = Value::undefined("no variation: all values are equal");
    description.variance = scaled.unscaledSquare(moments.variance());
    return description;
}

Value quantile(std::span<const double> ascending, double probability)
{
    if (ascending.empty()) return Value::undefined("there are no values");
    const double place = probability * static_cast<double>(ascending.size() - 1);
    const auto below = static_cast<std::size_t>(std::floor(place));
    const std::size_t above = std::min(below + 1, ascending.size() - 1);
    const double share = place - static_cast<double>(below);
    if (share == 0 || ascending[below] == ascending[above]) return ascending[below];
    // A weighted mean instead of low + share * (high - low), whose difference can overflow.
    return (1 - share) * ascending[below] + share * ascending[above];
}

Value median(std::span<const double> x)
{
    std::vector<double> ascending(x.begin(), x.end());
    std::sort(ascending.begin(), ascending.end());
    return quantile(ascending, 0.5);
}

}  // namespace stats
