#include "rendering/models/seeing/friction_target.h"

#include <algorithm>
#include <numeric>
#include <opencv2/core.hpp>

#include "protocols/files/errors.h"

namespace rendering::models {

namespace {

/// Sum of a periodic Hann window: the magnitude of a constant trace of 1 at frequency 0.
double windowSum(const Architecture& architecture) { return architecture.window / 2.0; }

/// The trace cut to a length, or continued by mirroring about its ends.
std::vector<double> fitted(std::span<const double> trace, int length)
{
    std::vector<double> result;
    const int last = static_cast<int>(trace.size()) - 1;
    for (int i = 0; i < length; ++i) {
        const int period = std::max(1, 2 * last);
        const int place = i % period;
        result.push_back(trace[static_cast<std::size_t>(place <= last ? place : period - place)]);
    }
    return result;
}

}  // namespace

signals::SpectrogramParameters spectrogramParameters(const Architecture& architecture)
{
    signals::SpectrogramParameters parameters;
    parameters.windowLength = architecture.window;
    parameters.fftSize = architecture.window;
    parameters.hop = architecture.hop;
    parameters.sampleRateHz = 1 / architecture.traceMmPerSample;
    return parameters;
}

void setSpectrogramShape(Architecture& architecture)
{
    const signals::SpectrogramParameters parameters = spectrogramParameters(architecture);
    signals::requireInvertible(parameters);
    architecture.rows = parameters.frequencies();
    architecture.frames = parameters.frames(architecture.traceSamples);
}

FrictionTarget frictionTarget(std::span<const double> trace, const Architecture& architecture)
{
    const std::vector<double> values = fitted(trace, architecture.traceSamples);
    const double mean = std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
    if (!(mean > 0))
        throw protocols::badInput({"the mean of a friction record is not positive", "friction", "coefficients above 0",
                                   "check the sign of the tangential axis"});
    const cv::Mat absolute = signals::magnitude(signals::stft(values, spectrogramParameters(architecture))).values;
    FrictionTarget target;
    target.mean = static_cast<float>(mean);
    cv::Mat ratio;
    absolute.convertTo(ratio, CV_32F, 1 / (mean * windowSum(architecture)), ratioFloor);
    cv::log(ratio, target.logRatio);
    return target;
}

cv::Mat magnitudes(const FrictionTarget& target, const Architecture& architecture)
{
    cv::Mat ratio, values;
    cv::exp(cv::min(target.logRatio, 10), ratio);
    ratio = cv::max(ratio - ratioFloor, 0);
    const double average = cv::mean(ratio.row(0))[0];
    if (average > 1e-6)
        ratio.row(0) /= average;
    else
        ratio.row(0) = 1;
    ratio.convertTo(values, CV_32F, target.mean * windowSum(architecture));
    return values;
}

std::vector<double> traceOf(const FrictionTarget& target, const Architecture& architecture, int iterations)
{
    signals::MagnitudeSpectrogram spectrogram;
    spectrogram.parameters = spectrogramParameters(architecture);
    spectrogram.traceLength = architecture.traceSamples;
    spectrogram.mean = target.mean;
    spectrogram.values = magnitudes(target, architecture);
    // The mean reaches the first two rows, where it exceeds all texture. An error of 3 % there would cause a slow wave as high
    // as the texture itself. So the texture is inverted without the mean, and its slowest wave gets the magnitude of the next.
    spectrogram.values.row(0) = 0;
    spectrogram.values.row(2).copyTo(spectrogram.values.row(1));
    signals::GriffinLimOptions options;
    options.iterations = iterations;
    return signals::griffinLim(spectrogram, options).trace;
}

}  // namespace rendering::models
