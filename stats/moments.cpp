#include "stats/moments.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "stats/exact_sum.h"

namespace stats {
namespace {

// Between these exponents no square or product of two squares can leave the range of double.
constexpr int smallestSafeExponent = -200;
constexpr int largestSafeExponent = 200;

double largestMagnitude(std::span<const double> x)
{
    double largest = 0;
    for (const double value : x) largest = std::max(largest, std::fabs(value));
    return largest;
}

}  // namespace

ScaledSamples::ScaledSamples(std::initializer_list<std::span<const double>> samples, std::initializer_list<double> references)
    : m_samples(samples)
{
    double largest = 0;
    for (const auto& sample : m_samples) largest = std::max(largest, largestMagnitude(sample));
    for (const double reference : references) largest = std::max(largest, std::fabs(reference));
    if (largest == 0) return;
    const int exponent = std::ilogb(largest);
    if (exponent >= smallestSafeExponent && exponent <= largestSafeExponent) return;
    m_exponent = exponent;
    m_copies.reserve(m_samples.size());
    for (auto& sample : m_samples) {
        auto& copy = m_copies.emplace_back(sample.begin(), sample.end());
        for (double& value : copy) value = std::ldexp(value, -exponent);
        sample = copy;
    }
}

double ScaledSamples::scaled(double reference) const { return m_exponent == 0 ? reference : std::ldexp(reference, -m_exponent); }

Value ScaledSamples::unscaled(double number) const
{
    if (m_exponent == 0) return number;
    const double value = std::ldexp(number, m_exponent);
    if (std::isinf(value) && !std::isinf(number))
        return Value::undefined("beyond the largest number that can be written as a double");
    return value;
}

Moments momentsOf(std::span<const double> x)
{
    Moments moments;
    moments.n = x.size();
    const auto n = static_cast<double>(x.size());
    moments.shift = exactSum(x.size(), [x](std::size_t i) { return x[i]; }) / n;
    const double shift = moments.shift;
    const double sum = exactSum(x.size(), [x, shift](std::size_t i) { return x[i] - shift; });
    const double squares = exactSum(x.size(), [x, shift](std::size_t i) { return (x[i] - shift) * (x[i] - shift); });
    moments.residual = sum / n;
    moments.squares = std::max(0.0, squares - sum * moments.residual);
    const auto [smallest, largest] = std::minmax_element(x.begin(), x.end());
    moments.smallest = *smallest;
    moments.largest = *largest;
    return moments;
}

double unitInLastPlace(double x)
{
    const double magnitude = std::fabs(x);
    return std::nextafter(magnitude, std::numeric_limits<double>::infinity()) - magnitude;
}

bool isConstant(const Moments& moments)
{
    const double magnitude = std::max(std::fabs(moments.smallest), std::fabs(moments.largest));
    return moments.largest - moments.smallest <= unitInLastPlace(magnitude) || moments.squares == 0;
}

std::string nonFiniteFault(std::span<const double> x, const std::string& name)
{
    const auto found = std::find_if(x.begin(), x.end(), [](double value) { return !std::isfinite(value); });
    if (found == x.end()) return {};
    return "value " + std::to_string(found - x.begin() + 1) + " of " + name +
           (std::isnan(*found) ? " is not a number" : " is infinite");
}

}  // namespace stats
