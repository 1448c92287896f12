#include "stats/metrics/spectrum_distance.h"

#include <cmath>
#include <numbers>

#include "stats/kernels/moments.h"

namespace stats {
namespace {

std::vector<double> hannWindow(std::size_t n)
{
    std::vector<double> window(n);
    for (std::size_t i = 0; i < n; ++i)
        window[i] = 0.5 - 0.5 * std::cos(2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(n));
    return window;
}

/// Adds |sum over t of x_t exp(-2 pi i f t / n)|^2 to the powers, from a table of one period.
void addPowers(const std::vector<double>& x, const std::vector<double>& cosines, std::vector<double>& powers)
{
    const std::size_t n = x.size();
    for (std::size_t f = 0; f < powers.size(); ++f) {
        double real = 0;
        double imaginary = 0;
        for (std::size_t i = 0; i < n; ++i) {
            const std::size_t angle = f * i % n;
            real += x[i] * cosines[angle];
            imaginary += x[i] * cosines[n + angle];
        }
        powers[f] += real * real + imaginary * imaginary;
    }
}

/// One period of the cosine, then one period of the sine.
std::vector<double> circle(std::size_t n)
{
    std::vector<double> values(2 * n);
    for (std::size_t i = 0; i < n; ++i) {
        const double angle = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(n);
        values[i] = std::cos(angle);
        values[n + i] = std::sin(angle);
    }
    return values;
}

std::string faultOf(std::span<const double> trace, std::size_t segment, const std::string& name)
{
    if (trace.size() < segment) return name + " is shorter than a segment of " + std::to_string(segment) + " values";
    return nonFiniteFault(trace, name);
}

}  // namespace

std::vector<double> powerSpectrum(std::span<const double> trace, std::size_t segment)
{
    if (segment < 4 || trace.size() < segment) return {};
    const std::vector<double> window = hannWindow(segment);
    const std::vector<double> cosines = circle(segment);
    std::vector<double> powers(segment / 2 + 1, 0.0);
    std::vector<double> part(segment);
    for (std::size_t begin = 0; begin + segment <= trace.size(); begin += segment - segment / 2) {
        const Moments moments = momentsOf(trace.subspan(begin, segment));
        for (std::size_t i = 0; i < segment; ++i) part[i] = window[i] * ((trace[begin + i] - moments.shift) - moments.residual);
        addPowers(part, cosines, powers);
    }
    return powers;
}

SpectrumDistance spectrumDistance(std::span<const double> generated, std::span<const double> truth, std::size_t segment)
{
    SpectrumDistance result;
    const auto refuse = [&](const std::string& why) {
        result.why = why;
        result.decibels = result.bias = Value::undefined(why);
        return result;
    };
    if (segment < 4) return refuse("a segment needs at least 4 values");
    if (const std::string fault = faultOf(generated, segment, "the generated trace"); !fault.empty()) return refuse(fault);
    if (const std::string fault = faultOf(truth, segment, "the true trace"); !fault.empty()) return refuse(fault);
    const ScaledSamples scaled({generated, truth});
    const auto g = powerSpectrum(scaled.sample(0), segment);
    const auto t = powerSpectrum(scaled.sample(1), segment);
    // The power of a trace is a sum over its own number of segments.
    const auto segments = [&](std::size_t n) { return static_cast<double>((n - segment) / (segment - segment / 2) + 1); };
    const double scale = segments(truth.size()) / segments(generated.size());
    double sum = 0;
    double squares = 0;
    for (std::size_t f = 1; f < g.size(); ++f) {
        if (!(g[f] > 0 && t[f] > 0)) return refuse("a trace has no power at frequency " + std::to_string(f) + " of the spectrum");
        const double decibels = 10 * std::log10(g[f] / t[f] * scale);
        sum += decibels;
        squares += decibels * decibels;
    }
    result.frequencies = g.size() - 1;
    const auto count = static_cast<double>(result.frequencies);
    result.decibels = std::sqrt(squares / count);
    result.bias = sum / count;
    return result;
}

}  // namespace stats
