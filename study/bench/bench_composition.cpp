#include "study/bench/bench_composition.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "protocols/random.h"
#include "rendering/composition/display_mapping.h"
#include "rendering/composition/friction_image.h"
#include "rendering/fabrics/recordings/even_steps.h"
#include "rendering/signals/spectrogram.h"
#include "study/bench/bench_frames.h"
#include "study/bench/bench_turns.h"
#include "study/bench/median_time.h"

namespace study::bench {

namespace {

namespace signals = rendering::signals;
using rendering::DisplayScale;
using rendering::Extension;
using rendering::Sources;

/// A twill of 0.9 mm with some noise at every place. Its period does not divide the size of a patch.
cv::Mat twill(int rows, int columns, double mmPerPixel)
{
    protocols::Random random(5);
    cv::Mat patch(rows, columns, CV_32FC1);
    for (int i = 0; i < rows; ++i)
        for (int j = 0; j < columns; ++j)
            patch.at<float>(i, j) = static_cast<float>(
                0.1 + 0.05 * std::sin(2 * std::numbers::pi * (0.87 * j + 0.5 * i) * mmPerPixel / 0.9) + 0.005 * random.normal());
    return patch;
}

std::vector<double> traceOf(std::size_t length)
{
    protocols::Random random(7);
    std::vector<double> trace(length);
    for (std::size_t i = 0; i < length; ++i)
        trace[i] = 0.5 + 0.03 * std::sin(0.65 * static_cast<double>(i)) + 0.005 * random.normal();
    return trace;
}

/// The signals of one fabric that each of the nine conditions uses.
std::map<std::string, Sources> readySources()
{
    using protocols::ReliefSource;
    const cv::Mat photograph = twill(512, 512, 0.04), tactile = twill(240, 320, 0.05);
    std::map<std::string, Sources> sources;
    for (const auto& id : protocols::conditionList("all")) {
        const auto& condition = protocols::conditionNamed(id.value);
        Sources one;
        const bool pressed = condition.relief == ReliefSource::GreyTactile || condition.relief == ReliefSource::PhotometricHeight;
        if (condition.relief != ReliefSource::None) {
            one.relief = pressed ? tactile : photograph;
            one.reliefMmPerPixel = pressed ? 0.05 : 0.04;
        }
        one.trace = traceOf(480);
        one.traceMmPerSample = 5.0 / 60;
        one.meanFriction = 0.5;
        sources[id.value] = one;
    }
    return sources;
}

cv::Mat spectrumOf(const cv::Mat& values)
{
    constexpr int size = 64;
    cv::Mat window, sum = cv::Mat::zeros(size, size, CV_32FC1);
    cv::createHanningWindow(window, {size, size}, CV_32F);
    for (int i = 0; i + size <= values.rows; i += size / 2)
        for (int j = 0; j + size <= values.cols; j += size / 2) {
            cv::Mat block = values(cv::Rect(j, i, size, size)).clone(), transformed, parts[2];
            block -= cv::mean(block)[0];
            cv::dft(block.mul(window), transformed, cv::DFT_COMPLEX_OUTPUT);
            cv::split(transformed, parts);
            sum += parts[0].mul(parts[0]) + parts[1].mul(parts[1]);
        }
    return sum / cv::sum(sum)[0];
}

/// Share of the texture's power, in percent, that has another direction or period on the whole screen than in its middle.
/// The middle shows the source unchanged.
double powerMoved(const cv::Mat& screen, cv::Size source)
{
    const cv::Rect middle((screen.cols - source.width) / 2, (screen.rows - source.height) / 2, source.width, source.height);
    return 100 * cv::norm(spectrumOf(screen), spectrumOf(screen(middle)), cv::NORM_L1) / 2;
}

void benchNineConditions(std::vector<BenchRow>& rows, DisplayScale scale)
{
    const auto sources = readySources();
    cv::Mat relief;
    const bool physical = scale == DisplayScale::Physical;
    const cv::Size source = physical ? cv::Size(94, 70) : cv::Size(320, 240);
    std::vector<TimedSetting> settings;
    for (const auto extension : {Extension::Tile, Extension::Mirror})
        settings.push_back({{std::string("nine conditions 800x1280, ") + (physical ? "physical" : "pixels"),
                             extension == Extension::Tile ? "tile" : "mirror",
                             {},
                             {},
                             "% of power moved",
                             "composed, ranged and mapped; share of a twill's power with another direction on the screen"},
                            [&, extension] {
                                for (const auto& [id, one] : sources) {
                                    const auto map = compose(protocols::conditionNamed(id), one, scale, extension);
                                    rendering::MapRange range;
                                    range.include(map);
                                    mapToDisplay(map, range);
                                    if (id == "h") relief = map.values;
                                }
                            },
                            [&] { return powerMoved(relief, source); }});
    for (BenchRow& row : benchInTurns(settings, {7})) rows.push_back(std::move(row));
}

void benchResampling(std::vector<BenchRow>& rows)
{
    protocols::Random random(3);
    const auto truth = [](double t) { return 0.5 + 0.05 * std::sin(2 * std::numbers::pi * 2 * t); };
    std::vector<double> times, values;
    for (double t = 0; times.size() < 100000; t += 0.02 + 0.016 * random.uniform()) {
        times.push_back(t);
        values.push_back(truth(t));
    }
    std::vector<double> even;
    double step = 0;
    const double time = medianMilliseconds(7, [&] {
        step = rendering::fabrics::timeBaseOf(times, "bench").stepS;
        even = rendering::fabrics::atEvenSteps(times, values, step);
    });
    double sum = 0;
    for (std::size_t i = 0; i < even.size(); ++i) sum += std::pow(even[i] - truth(static_cast<double>(i) * step), 2);
    rows.push_back({"friction record resampled", "linear", time, 100 * std::sqrt(sum / static_cast<double>(even.size())) / 0.5,
                    "% of mean", "100 000 samples, steps of 20 to 36 ms; a tone of 2 Hz and 10 %"});
}

void benchRoundTrip(std::vector<BenchRow>& rows)
{
    const auto trace = traceOf(480);
    std::vector<double> back;
    const double time = medianMilliseconds(7, [&] { back = signals::istft(signals::stft(trace)); });
    double largest = 0;
    for (std::size_t i = 0; i < trace.size(); ++i) largest = std::max(largest, std::abs(back[i] - trace[i]));
    rows.push_back({"spectrogram round trip", "complex", time, largest, "largest difference", "480 samples of about 0.5"});
}

void benchMean(std::vector<BenchRow>& rows)
{
    const auto trace = traceOf(480);
    const auto spectrogram = signals::stft(trace);
    auto magnitude = signals::magnitude(spectrogram);
    signals::Inversion inversion;
    const double time = medianMilliseconds(7, [&] {
        magnitude.mean = signals::meanFromMagnitude(magnitude.values, magnitude.parameters);
        inversion = signals::griffinLim(magnitude, signals::GriffinLimOptions::of(signals::InversionQuality::Fast));
    });
    double mean = 0;
    for (const double value : inversion.trace) mean += value / static_cast<double>(inversion.trace.size());
    std::string course;
    for (const std::size_t iteration : {std::size_t{0}, std::size_t{1}, std::size_t{4}, inversion.convergence.size() / 2})
        course += std::to_string(std::lround(100 * inversion.convergence.at(iteration))) + ", ";
    rows.push_back({"mean through a magnitude alone", "fast", time, 100 * std::abs(mean / spectrogram.mean - 1), "% of mean",
                    "read from the row of frequency 0, then Griffin-Lim; its magnitudes deviated by " + course +
                        std::to_string(std::lround(100 * inversion.spectralConvergence)) +
                        " % before iterations 1, 2, 5 and 17 and at its end"});
}

}  // namespace

std::vector<BenchRow> benchComposition()
{
    const int threads = cv::getNumThreads();
    cv::setNumThreads(1);
    std::vector<BenchRow> rows;
    for (const auto scale : {DisplayScale::Pixels, DisplayScale::Physical}) benchNineConditions(rows, scale);
    benchResampling(rows);
    benchRoundTrip(rows);
    benchMean(rows);
    for (BenchRow& row : benchFrames()) rows.push_back(std::move(row));
    cv::setNumThreads(threads);
    return rows;
}

}  // namespace study::bench
