#include "study/evaluation/friction_comparison.h"

#include <algorithm>
#include <cmath>

#include "rendering/signals/friction_trace.h"
#include "stats/metrics/spectrum_distance.h"
#include "stats/metrics/trace_error.h"

namespace study::evaluation {

namespace {

constexpr std::size_t segment = 64;  // segment length of the generators' spectrogram
constexpr std::size_t shortestSegment = 8;
constexpr double sameSpacing = 0.01;  // share by which two spacings may differ
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

/// Whether two spacings agree, or one is unknown.
bool areOneSpacing(double a, double b) { return !(a > 0 && b > 0) || std::abs(a / b - 1) < sameSpacing; }

/// Samples that span 64 samples of the model.
std::size_t usualSegment(double mmPerSample, double modelMmPerSample)
{
    if (areOneSpacing(mmPerSample, modelMmPerSample)) return segment;
    const double samples = static_cast<double>(segment) * modelMmPerSample / mmPerSample;
    return std::max(shortestSegment, static_cast<std::size_t>(std::lround(samples)));
}

/// The usual segment, halved until it fits twice into `length`, but not below 8 samples.
std::size_t segmentFor(std::size_t length, std::size_t usual)
{
    std::size_t fitting = usual;
    while (fitting > shortestSegment && 2 * fitting > length) fitting = std::max(shortestSegment, fitting / 2);
    return fitting;
}

stats::Value envelopeDistance(const std::vector<double>& generated, const std::vector<double>& measured, std::size_t usual)
{
    if (isConstant(generated) || isConstant(measured)) return stats::Value::undefined(constantWhy);
    if (!(meanOf(generated) > 0 && meanOf(measured) > 0)) return stats::Value::undefined("the mean of a trace is not above 0");
    const auto length = segmentFor(std::min(generated.size(), measured.size()), usual);
    return stats::spectrumDistance(overMean(generated), overMean(measured), length).decibels;
}

}  // namespace

Trace constantTrace(double value, std::size_t length) { return {std::vector<double>(length, value), 0}; }

Trace atSpacing(Trace trace, double mmPerSample)
{
    if (areOneSpacing(trace.mmPerSample, mmPerSample) || trace.values.size() < 2) return trace;
    return {rendering::signals::atSpacing(trace.values, trace.mmPerSample, mmPerSample), mmPerSample};
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

void compareTraces(const Trace& generated, const Trace& measured, Values& values, double modelMmPerSample)
{
    const std::size_t length = std::min(generated.values.size(), measured.values.size());
    const std::span<const double> a(generated.values.data(), length), b(measured.values.data(), length);
    const auto error = stats::traceError(a, b);
    at(values, Measure::FrictionMae) = error.mae;
    at(values, Measure::FrictionMaeOverMean) = error.maeOverMean;
    const double mean = meanOf(generated.values), truth = meanOf(measured.values);
    at(values, Measure::MeanFrictionError) =
        truth > 0 ? stats::Value(std::abs(mean - truth) / truth) : stats::Value::undefined("the measured mean is not above 0");
    at(values, Measure::FrictionSpectrum) =
        envelopeDistance(generated.values, measured.values, usualSegment(measured.mmPerSample, modelMmPerSample));
    at(values, Measure::MeanFriction) = mean;
}

stats::Value ownMeanError(const Trace& measured)
{
    return stats::traceError(constantTrace(meanOf(measured.values), measured.values.size()).values, measured.values).maeOverMean;
}

}  // namespace study::evaluation
