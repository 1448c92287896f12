#include "rendering/signals/spectrogram.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <opencv2/core.hpp>
#include <string>

#include "protocols/files/errors.h"
#include "protocols/random.h"

namespace rendering::signals {

namespace {

using Bin = cv::Vec2d;

/// Window of the length of the transform, with the Hann window in its middle.
std::vector<double> windowOf(const SpectrogramParameters& parameters)
{
    std::vector<double> window(static_cast<std::size_t>(parameters.fftSize), 0.0);
    const int start = (parameters.fftSize - parameters.windowLength) / 2;
    for (int i = 0; i < parameters.windowLength; ++i)
        window[static_cast<std::size_t>(start + i)] = 0.5 - 0.5 * std::cos(2 * std::numbers::pi * i / parameters.windowLength);
    return window;
}

/// Index into the trace of a place before, in or after it; the trace is mirrored about its end samples.
int mirrored(int place, int length)
{
    if (length == 1) return 0;
    if (place >= 0 && place < length) return place;
    const int period = 2 * (length - 1);
    const int inPeriod = ((place % period) + period) % period;
    return inPeriod < length ? inPeriod : period - inPeriod;
}

double meanOf(std::span<const double> values)
{
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// Spectrum in the layout of OpenCV, [frame x frequency]. Works in blocks of frames, so that a trace of 10^7 samples is not
/// held four times.
cv::Mat analysed(std::span<const double> trace, const SpectrogramParameters& parameters, const std::vector<double>& window)
{
    constexpr int framesAtOnce = 4096;
    const int length = static_cast<int>(trace.size()), n = parameters.fftSize, frames = parameters.frames(length);
    cv::Mat result(frames, parameters.frequencies(), CV_64FC2), pieces, spectrum;
    for (int first = 0; first < frames; first += framesAtOnce) {
        const int count = std::min(framesAtOnce, frames - first);
        pieces.create(count, n, CV_64FC1);
        for (int frame = 0; frame < count; ++frame) {
            double* piece = pieces.ptr<double>(frame);
            const int start = (first + frame) * parameters.hop - n / 2;
            for (int i = 0; i < n; ++i)
                piece[i] = window[static_cast<std::size_t>(i)] * trace[static_cast<std::size_t>(mirrored(start + i, length))];
        }
        cv::dft(pieces, spectrum, cv::DFT_ROWS | cv::DFT_COMPLEX_OUTPUT);
        spectrum.colRange(0, result.cols).copyTo(result.rowRange(first, first + count));
    }
    return result;
}

cv::Mat withNegativeFrequencies(const cv::Mat& half, int n)
{
    cv::Mat full(half.rows, n, CV_64FC2);
    half.copyTo(full.colRange(0, half.cols));
    for (int frame = 0; frame < half.rows; ++frame)
        for (int k = half.cols; k < n; ++k) {
            const Bin bin = half.at<Bin>(frame, n - k);
            full.at<Bin>(frame, k) = {bin[0], -bin[1]};
        }
    return full;
}

std::vector<double> synthesised(const cv::Mat& half, int length, const SpectrogramParameters& parameters,
                                const std::vector<double>& window)
{
    const int n = parameters.fftSize;
    cv::Mat pieces;
    cv::dft(withNegativeFrequencies(half, n), pieces, cv::DFT_INVERSE | cv::DFT_SCALE | cv::DFT_ROWS | cv::DFT_REAL_OUTPUT);
    std::vector<double> sum(static_cast<std::size_t>(length), 0.0), weight(sum);
    for (int frame = 0; frame < pieces.rows; ++frame) {
        const double* piece = pieces.ptr<double>(frame);
        const int start = frame * parameters.hop - n / 2;
        for (int i = std::max(0, -start); i < std::min(n, length - start); ++i) {
            const auto place = static_cast<std::size_t>(start + i);
            const double w = window[static_cast<std::size_t>(i)];
            sum[place] += w * piece[i];
            weight[place] += w * w;
        }
    }
    std::transform(sum.begin(), sum.end(), weight.begin(), sum.begin(), std::divides<>());
    return sum;
}

void requireSize(const cv::Mat& values, const SpectrogramParameters& parameters, int traceLength)
{
    if (traceLength < 2 || values.rows != parameters.frequencies() || values.cols != parameters.frames(traceLength))
        throw protocols::badInput(
            {.what = "a spectrogram of " + std::to_string(values.rows) + " x " + std::to_string(values.cols) +
                     " values does not match a trace of " + std::to_string(traceLength) + " samples",
             .where = "",
             .expected =
                 std::to_string(parameters.frequencies()) + " x " + std::to_string(parameters.frames(traceLength)) + " values",
             .nextStep = "read the spectrogram with its own parameters"});
}

/// Magnitude of a bin. Larger values than 1e100 are refused, so squares do not overflow; hypot would take half the time of an
/// inversion.
double magnitudeOf(const Bin& bin) { return std::sqrt(bin[0] * bin[0] + bin[1] * bin[1]); }

Bin unit(const Bin& bin)
{
    const double size = magnitudeOf(bin);
    return size > 0 ? bin * (1 / size) : Bin{1, 0};
}

cv::Mat firstPhases(const cv::Mat& magnitude, std::uint64_t seed)
{
    auto random = protocols::Random::stream(seed, "griffin-lim phases");
    cv::Mat phases(magnitude.size(), CV_64FC2);
    for (int frame = 0; frame < phases.rows; ++frame)
        for (int k = 0; k < phases.cols; ++k) {
            const double angle = 2 * std::numbers::pi * random.uniform();
            phases.at<Bin>(frame, k) = k == 0 ? Bin{1, 0} : Bin{std::cos(angle), std::sin(angle)};
        }
    return phases;
}

cv::Mat withPhases(const cv::Mat& magnitude, const cv::Mat& phases, int fftSize)
{
    cv::Mat result(magnitude.size(), CV_64FC2);
    for (int frame = 0; frame < result.rows; ++frame)
        for (int k = 0; k < result.cols; ++k) {
            Bin phase = phases.at<Bin>(frame, k);
            if (2 * k == fftSize)  // At half the sample rate the spectrum of a real trace is real.
                phase = {phase[0] < 0 ? -1.0 : 1.0, 0.0};
            result.at<Bin>(frame, k) = phase * magnitude.at<double>(frame, k);
        }
    return result;
}

/// Phases of the spectrum of the last trace, extrapolated in the direction of its change.
void advance(cv::Mat& phases, const cv::Mat& spectrum, const cv::Mat& before, double momentum)
{
    for (int frame = 0; frame < phases.rows; ++frame)
        for (int k = 1; k < phases.cols; ++k) {
            const Bin now = spectrum.at<Bin>(frame, k);
            phases.at<Bin>(frame, k) = unit(before.empty() ? now : now + (now - before.at<Bin>(frame, k)) * momentum);
        }
}

double convergence(const cv::Mat& spectrum, const cv::Mat& magnitude)
{
    double wrong = 0, wanted = 0, all = 0;
    for (int frame = 0; frame < magnitude.rows; ++frame)
        for (int k = 0; k < magnitude.cols; ++k) {
            const double target = magnitude.at<double>(frame, k);
            all += target * target;
            if (k < 2) continue;
            const Bin bin = spectrum.at<Bin>(frame, k);
            const double apart = magnitudeOf(bin) - target;
            wrong += apart * apart;
            wanted += target * target;
        }
    // Apart from its mean a constant trace contains only rounding.
    return wanted > 1e-20 * all ? std::sqrt(wrong / wanted) : 0;
}

}  // namespace

void requireConstantOverlap(const SpectrogramParameters& parameters)
{
    requireInvertible(parameters);
    const auto window = windowOf(parameters);
    double least = 0, most = 0;
    for (int offset = 0; offset < parameters.hop; ++offset) {
        double weight = 0;
        for (int i = offset; i < parameters.fftSize; i += parameters.hop) weight += window[static_cast<std::size_t>(i)];
        least = offset == 0 ? weight : std::min(least, weight);
        most = std::max(most, weight);
    }
    if (most - least > 0.001 * most)
        throw protocols::badInput({.what = "windows of " + std::to_string(parameters.windowLength) + " at a hop of " +
                                           std::to_string(parameters.hop) + " do not add up to a constant",
                                   .where = "",
                                   .expected = "a hop that divides half the window",
                                   .nextStep = "choose another window or hop"});
}

void requireInvertible(const SpectrogramParameters& parameters)
{
    const auto& p = parameters;
    if (p.windowLength < 2 || p.hop < 1 || p.fftSize < p.windowLength || !(p.sampleRateHz > 0) || !std::isfinite(p.sampleRateHz))
        throw protocols::badInput({.what = "a spectrogram with window " + std::to_string(p.windowLength) + ", hop " +
                                           std::to_string(p.hop) + " and transform " + std::to_string(p.fftSize) +
                                           " is impossible",
                                   .where = "",
                                   .expected = "hop >= 1, 2 <= window <= transform, a sample rate above 0",
                                   .nextStep = "choose other parameters"});
    const auto window = windowOf(p);
    for (int offset = 0; offset < p.hop; ++offset) {
        double weight = 0;
        for (int i = offset; i < p.fftSize; i += p.hop) weight += std::pow(window[static_cast<std::size_t>(i)], 2);
        if (weight < 1e-6)
            throw protocols::badInput({.what = "a hop of " + std::to_string(p.hop) + " leaves samples without a window of " +
                                               std::to_string(p.windowLength) + ", so the spectrogram cannot be inverted",
                                       .where = "",
                                       .expected = "a hop of at most half the window",
                                       .nextStep = "choose another window or hop"});
    }
}

Spectrogram stft(std::span<const double> trace, const SpectrogramParameters& parameters)
{
    requireInvertible(parameters);
    if (trace.size() < 2)
        throw protocols::badInput({.what = "a trace of " + std::to_string(trace.size()) + " samples has no spectrogram",
                                   .where = "",
                                   .expected = "at least 2 samples",
                                   .nextStep = "record a longer stroke"});
    if (!std::all_of(trace.begin(), trace.end(), [](double v) { return std::abs(v) < 1e100; }))
        throw protocols::badInput({.what = "the trace holds values that are not finite or exceed 1e100",
                                   .where = "",
                                   .expected = "finite numbers",
                                   .nextStep = "correct the record"});
    Spectrogram result{parameters, static_cast<int>(trace.size()), meanOf(trace), {}};
    cv::transpose(analysed(trace, parameters, windowOf(parameters)), result.values);
    return result;
}

std::vector<double> istft(const Spectrogram& spectrogram)
{
    requireInvertible(spectrogram.parameters);
    requireSize(spectrogram.values, spectrogram.parameters, spectrogram.traceLength);
    return synthesised(spectrogram.values.t(), spectrogram.traceLength, spectrogram.parameters, windowOf(spectrogram.parameters));
}

MagnitudeSpectrogram magnitude(const Spectrogram& spectrogram)
{
    MagnitudeSpectrogram result{spectrogram.parameters, spectrogram.traceLength, spectrogram.mean, {}};
    std::vector<cv::Mat> parts;
    cv::split(spectrogram.values, parts);
    cv::magnitude(parts[0], parts[1], result.values);
    return result;
}

double meanFromMagnitude(const cv::Mat& values, const SpectrogramParameters& parameters)
{
    requireConstantOverlap(parameters);
    cv::Mat row;
    values.row(0).convertTo(row, CV_64F);
    const int last = row.cols - 1;
    // The first and the last frame are centred on the ends of the trace, so half of each lies outside.
    const double ends = (row.at<double>(0) + row.at<double>(last)) / 2;
    const double average = last == 0 ? row.at<double>(0) : (cv::sum(row)[0] - ends) / last;
    const auto window = windowOf(parameters);
    return average / std::accumulate(window.begin(), window.end(), 0.0);
}

GriffinLimOptions GriffinLimOptions::of(InversionQuality quality)
{
    GriffinLimOptions options;
    options.iterations = quality == InversionQuality::Fast ? 32 : 200;
    return options;
}

Inversion griffinLim(const MagnitudeSpectrogram& spectrogram, const GriffinLimOptions& options)
{
    const auto& parameters = spectrogram.parameters;
    requireInvertible(parameters);
    requireSize(spectrogram.values, parameters, spectrogram.traceLength);
    cv::Mat wanted;
    cv::Mat(spectrogram.values.t()).convertTo(wanted, CV_64F);
    double least = 0, most = 0;
    cv::minMaxLoc(wanted, &least, &most);
    if (!cv::checkRange(wanted) || least < 0 || most > 1e100 || !std::isfinite(spectrogram.mean))
        throw protocols::badInput(
            {.what = "the magnitude of the spectrogram holds values that are negative, above 1e100 or not finite",
             .where = "",
             .expected = "magnitudes >= 0 and a finite mean",
             .nextStep = "compute the spectrogram again"});

    const auto window = windowOf(parameters);
    cv::Mat phases = firstPhases(wanted, options.seed), before;
    Inversion result;
    for (int i = 0; i < options.iterations; ++i) {
        const auto guess =
            synthesised(withPhases(wanted, phases, parameters.fftSize), spectrogram.traceLength, parameters, window);
        const cv::Mat spectrum = analysed(guess, parameters, window);
        result.convergence.push_back(convergence(spectrum, wanted));
        advance(phases, spectrum, before, options.momentum);
        before = spectrum;
    }
    result.trace = synthesised(withPhases(wanted, phases, parameters.fftSize), spectrogram.traceLength, parameters, window);
    const double shift = spectrogram.mean - meanOf(result.trace);
    for (double& value : result.trace) value += shift;
    result.spectralConvergence = convergence(analysed(result.trace, parameters, window), wanted);
    return result;
}

}  // namespace rendering::signals
