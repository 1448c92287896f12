#include "rendering/models/friction_target.h"

#include "protocols/errors.h"
#include "rendering/signals/spectrogram.h"

#include <opencv2/core.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace rendering::models {

namespace {

signals::SpectrogramParameters parametersOf(const Architecture& architecture)
{
    signals::SpectrogramParameters parameters;
    parameters.windowLength = architecture.window;
    parameters.fftSize = architecture.window;
    parameters.hop = architecture.hop;
    parameters.sampleRateHz = 1 / architecture.traceMmPerSample;  // samples a millimetre: the same law, no speed in it
    return parameters;
}

/// Of a periodic Hann window; what a constant trace of 1 gives in the row of frequency 0.
double windowSum(const Architecture& architecture) { return architecture.window / 2.0; }

/// Cut to length, or continued by mirroring about its ends.
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

/// Magnitudes of what varies about the mean; its slowest part, the row of frequency 0, is left out.
cv::Mat variation(const FrictionTarget& target, const Architecture& architecture)
{
    cv::Mat ratio, values;
    cv::exp(cv::min(target.logRatio, 3), ratio);
    ratio = cv::max(ratio - ratioFloor, 0);
    ratio.row(0) = 0;
    ratio.convertTo(values, CV_32F, target.mean * windowSum(architecture));
    return values;
}

}  // namespace

void setSpectrogramShape(Architecture& architecture)
{
    const signals::SpectrogramParameters parameters = parametersOf(architecture);
    signals::requireInvertible(parameters);
    architecture.rows = parameters.frequencies();
    architecture.frames = parameters.frames(architecture.traceSamples);
}

FrictionTarget frictionTarget(std::span<const double> trace, const Architecture& architecture)
{
    std::vector<double> values = fitted(trace, architecture.traceSamples);
    const double mean = std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
    if (!(mean > 0))
        throw protocols::badInput({"a friction record whose mean is not positive", "friction", "coefficients above 0", ""});
    for (double& value : values)
        value -= mean;
    const cv::Mat absolute = signals::magnitude(signals::stft(values, parametersOf(architecture))).values;
    FrictionTarget target;
    target.mean = static_cast<float>(mean);
    cv::Mat ratio;
    absolute.convertTo(ratio, CV_32F, 1 / (mean * windowSum(architecture)), ratioFloor);
    cv::log(ratio, target.logRatio);
    return target;
}

std::vector<double> traceOf(const FrictionTarget& target, const Architecture& architecture, int iterations)
{
    signals::MagnitudeSpectrogram spectrogram;
    spectrogram.parameters = parametersOf(architecture);
    spectrogram.traceLength = architecture.traceSamples;
    spectrogram.mean = 0;
    spectrogram.values = variation(target, architecture);
    signals::GriffinLimOptions options;
    options.iterations = iterations;
    std::vector<double> trace = signals::griffinLim(spectrogram, options).trace;
    for (double& value : trace)
        value += target.mean;
    return trace;
}

cv::Mat spectrogramOf(std::span<const double> trace, const Architecture& architecture)
{
    cv::Mat values;
    signals::magnitude(signals::stft(trace, parametersOf(architecture))).values.convertTo(values, CV_32F);
    return values;
}

}  // namespace rendering::models
