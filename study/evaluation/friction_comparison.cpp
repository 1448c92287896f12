#include "study/evaluation/friction_comparison.h"

#include <algorithm>
#include <cmath>

#include "stats/metrics/spectrum_distance.h"
#include "stats/metrics/trace_error.h"

namespace study::evaluation {

namespace {

constexpr std::size_t segment = 64;  // segment length of the generators' spectrogram
constexpr std::size_t frequenciesOfBand = 4;
constexpr const char* constantWhy = "a constant has no texture";

double meanOf(const std::vector<double>& values)
{
    double sum = 0;
    for (const double value : values) sum += value;
    return values.empty() ? 0 : sum / static_cast<double>(values.size());
}

bool isConstant(const std::vector<double>& values)
{
    return std::all_of(values.begin(), values.end(), [&](double value) { return value == values.front(); });
}

std::vector<double> overMean(const std::vector<double>& values)
{
    const double mean = meanOf(values);
    std::vector<double> result(values);
    for (double& value : result) value /= mean;
    return result;
}

/// The longest power of two that fits twice into `length`, from 8 to 64 samples.
std::size_t segmentFor(std::size_t length)
{
    std::size_t fitting = segment;
    while (fitting > 8 && 2 * fitting > length) fitting /= 2;
    return fitting;
}

stats::Value envelopeDistance(const std::vector<double>& generated, const std::vector<double>& measured)
{
    if (isConstant(generated) || isConstant(measured)) return stats::Value::undefined(constantWhy);
    if (!(meanOf(generated) > 0 && meanOf(measured) > 0)) return stats::Value::undefined("the mean of a trace is not above 0");
    const auto length = segmentFor(std::min(generated.size(), measured.size()));
    return stats::spectrumDistance(overMean(generated), overMean(measured), length).decibels;
}

}  // namespace

Trace constantTrace(double value, std::size_t length) { return {std::vector<double>(length, value), 0}; }

Trace atSpacing(Trace trace, double mmPerSample)
{
    if (!(trace.mmPerSample > 0 && mmPerSample > 0) || std::abs(trace.mmPerSample / mmPerSample - 1) < 0.01 ||
        trace.values.size() < 2)
        return trace;
    const double last = static_cast<double>(trace.values.size() - 1), step = mmPerSample / trace.mmPerSample;
    Trace result{{}, mmPerSample};
    for (double place = 0; place <= last; place += step) {
        const auto left = std::min(static_cast<std::size_t>(place), trace.values.size() - 2);
        const double blend = place - static_cast<double>(left);
        result.values.push_back(trace.values[left] * (1 - blend) + trace.values[left + 1] * blend);
    }
    return result;
}

FrictionFeatures frictionFeatures(const Trace& trace)
{
    FrictionFeatures features{meanOf(trace.values), {}};
    if (trace.values.size() < segment) return features;
    if (isConstant(trace.values) || !(features.mean > 0)) {
        features.bandPowers.assign(segment / 2 / frequenciesOfBand, 0.0);
        return features;
    }
    const auto powers = stats::powerSpectrum(overMean(trace.values), segment);
    const std::size_t segments = (trace.values.size() - segment) / (segment / 2) + 1;
    for (std::size_t first = 1; first + frequenciesOfBand <= powers.size(); first += frequenciesOfBand) {
        double sum = 0;
        for (std::size_t f = first; f < first + frequenciesOfBand; ++f) sum += powers[f];
        features.bandPowers.push_back(sum / static_cast<double>(frequenciesOfBand * segments));
    }
    return features;
}

void compareTraces(const Trace& generated, const Trace& measured, Values& values)
{
    const std::size_t length = std::min(generated.values.size(), measured.values.size());
    const std::span<const double> a(generated.values.data(), length), b(measured.values.data(), length);
    const auto error = stats::traceError(a, b);
    at(values, Measure::FrictionMae) = error.mae;
    at(values, Measure::FrictionMaeOverMean) = error.maeOverMean;
    const double mean = meanOf(generated.values), truth = meanOf(measured.values);
    at(values, Measure::MeanFrictionError) =
        truth > 0 ? stats::Value(std::abs(mean - truth) / truth) : stats::Value::undefined("the measured mean is not above 0");
    at(values, Measure::FrictionSpectrum) = envelopeDistance(generated.values, measured.values);
    at(values, Measure::MeanFriction) = mean;
}

stats::Value ownMeanError(const Trace& measured)
{
    return stats::traceError(constantTrace(meanOf(measured.values), measured.values.size()).values, measured.values).maeOverMean;
}

}  // namespace study::evaluation
