#include "study/bench/extremes/extreme_signals.h"

#include <cmath>
#include <limits>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "rendering/composition/display_mapping.h"
#include "rendering/composition/friction_image.h"
#include "rendering/display/stroke.h"
#include "rendering/signals/friction_trace.h"
#include "rendering/signals/grey.h"
#include "rendering/signals/roughness.h"
#include "rendering/signals/shape_from_shading.h"
#include "rendering/signals/spectrogram.h"
#include "rendering/signals/surface_integration.h"

namespace study::bench {

namespace {

namespace signals = rendering::signals;
using Cases = std::vector<ExtremeCase>;

constexpr double pitchMm = 0.05;
const double notANumber = std::numeric_limits<double>::quiet_NaN();
const char* plane = "a plane: slope x length";
const char* noNumber = "no such number exists";

/// A case of a room whose functions throw where there is no answer.
ExtremeCase signalCase(std::string input, std::string asked, std::string truth, std::string source, double digits,
                       std::function<double()> ours, PeerRequest peer = {})
{
    return {"signals",
            std::move(input),
            std::move(asked),
            std::move(truth),
            std::move(source),
            digits,
            [ours = std::move(ours)] { return answerOrFault(ours); },
            std::move(peer)};
}

signals::Slopes tilted(int rows, int columns, double slope)
{
    return {cv::Mat(rows, columns, CV_64FC1, cv::Scalar(slope)), cv::Mat(rows, columns, CV_64FC1, cv::Scalar(0))};
}

/// Rise along the first row of the integrated surface, mm.
double riseOf(const cv::Mat& height) { return height.at<double>(0, height.cols - 1) - height.at<double>(0, 0); }

ExtremeCase tiltCase(const std::string& input, int rows, int columns, double slope, const std::string& truth, double digits)
{
    return signalCase(input, "rise along a row, mm", truth, plane, digits,
                      [=] {
                          return riseOf(signals::integrate(tilted(rows, columns, slope), {pitchMm, pitchMm}));
                      },
                      {"rise of a plane", {{static_cast<double>(rows), static_cast<double>(columns), slope, pitchMm}}});
}

void addIntegration(Cases& cases)
{
    cases.push_back(tiltCase("slopes of 1 x 1 pixel", 1, 1, 0.7, "0", 16));
    cases.push_back(tiltCase("a tilt of 1e6 mm/mm, 64 x 64", 64, 64, 1e6, "3150000", 12));
    cases.push_back(tiltCase("a tilt of 1e-300 mm/mm, 64 x 64", 64, 64, 1e-300, "3.15e-300", 12));
    cases.push_back(tiltCase("a tilt of 1e300 mm/mm, 64 x 64", 64, 64, 1e300, "3.15e+300", 12));
    cases.push_back(tiltCase("1 row of 4,096 pixels, a tilt of 1", 1, 4096, 1, "204.75", 11));
    const auto holed = [] {
        auto slopes = tilted(64, 64, 1);
        cv::circle(slopes.x, {30, 33}, 9, cv::Scalar(notANumber), cv::FILLED);
        return slopes;
    };
    cases.push_back(signalCase("a tilt of 1 with a disc of NaN, 64 x 64", "rise along a row, mm", "3.15", plane, 4, [=] {
        return riseOf(signals::integrateAround(holed(), {}, {pitchMm, pitchMm}));
    }));
    cases.push_back(
        signalCase("a tilt of 1 with a disc of NaN, no gaps allowed", "rise along a row, mm", "refused", noNumber, 0, [=] {
            return riseOf(signals::integrate(holed(), {pitchMm, pitchMm}));
        }));
    cases.push_back(signalCase("slopes that are all NaN", "rise along a row, mm", "refused", noNumber, 0, [] {
        return riseOf(signals::integrateAround(tilted(8, 8, notANumber), {}, {pitchMm, pitchMm}));
    }));
    cases.push_back(signalCase("a pitch of 0", "rise along a row, mm", "refused", noNumber, 0, [] {
        return riseOf(signals::integrate(tilted(8, 8, 1), {0, 0}));
    }));
}

double largestRelief(const cv::Mat& photograph) { return cv::norm(signals::shapeFromShading(photograph), cv::NORM_INF); }

void addPhotographs(Cases& cases)
{
    for (const auto& [name, level] : {std::pair{"black", 0}, std::pair{"white", 255}})
        cases.push_back(signalCase(std::string("a photograph that is all ") + name, "largest relief, px", "0", "nothing varies",
                                   16, [level = level] { return largestRelief(cv::Mat(64, 64, CV_8UC1, cv::Scalar(level))); }));
    cases.push_back(signalCase("a photograph of 1 pixel", "largest relief, px", "0", "nothing varies", 16,
                               [] { return largestRelief(cv::Mat(1, 1, CV_8UC1, cv::Scalar(77))); }));
    cases.push_back(signalCase("a photograph without pixels", "largest relief, px", "refused", noNumber, 0,
                               [] { return largestRelief(cv::Mat()); }));
    cases.push_back(signalCase("white of 16 bits", "grey", "65535", "the weights of the channels sum to 1", 6,
                               [] { return signals::grey(cv::Mat(1, 1, CV_16UC3, cv::Scalar::all(65535))).at<float>(0, 0); },
                               {"grey of 16 bits", {{65535, 65535, 65535}}}));
}

double largestDifference(const std::vector<double>& a, const std::vector<double>& b)
{
    double largest = a.size() == b.size() ? 0 : notANumber;
    for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
    return largest;
}

/// Peers take windows of 64 samples only.
ExtremeCase roundTrip(const std::string& input, const std::vector<double>& trace, double digits)
{
    double largest = 1e-300;
    for (const double value : trace) largest = std::max(largest, std::abs(value));
    return signalCase(input, "largest error of spectrogram and back, relative", "0", "the transform is its own inverse", digits,
                      [=] { return largestDifference(signals::istft(signals::stft(trace)), trace) / largest; },
                      {trace.size() < 64 ? "" : "spectrogram and back", {trace}});
}

void addTraces(Cases& cases)
{
    std::vector<double> alternating(480, 0.3), large(480);
    for (std::size_t i = 0; i < alternating.size(); i += 2) alternating[i] = 0.7;
    for (std::size_t i = 0; i < large.size(); ++i) large[i] = 1e90 * (1 + static_cast<double>(i % 7));
    cases.push_back(roundTrip("a trace of 2 samples", {0.4, 0.6}, 14));
    cases.push_back(roundTrip("a trace at half its sample rate", alternating, 14));
    cases.push_back(roundTrip("a trace of 1e90", large, 14));
    cases.push_back(roundTrip("a trace of zeros", std::vector<double>(480, 0.0), 16));
    cases.push_back(signalCase("a trace of 1e101", "largest error of spectrogram and back, relative", "refused",
                               "its squares would leave the range of double", 0,
                               [] { return signals::stft(std::vector<double>(480, 1e101)).mean; }));
    cases.push_back(
        signalCase("a silent magnitude with mean 0.5", "mean of the inverted trace", "0.5", "the mean is stored", 15, [] {
            signals::MagnitudeSpectrogram silent{{}, 480, 0.5, {}};
            silent.values = cv::Mat::zeros(silent.parameters.frequencies(), silent.parameters.frames(480), CV_64FC1);
            const auto found = signals::griffinLim(silent).trace;
            double sum = 0;
            for (const double value : found) sum += value;
            return sum / static_cast<double>(found.size());
        }));
    const auto record = [](std::size_t samples, double friction) {
        rendering::fabrics::FrictionRecord one;
        for (std::size_t i = 0; i < samples; ++i) {
            one.timeS.push_back(static_cast<double>(i) / 60);
            one.values.push_back(friction);
        }
        return one;
    };
    cases.push_back(signalCase("a record without any friction", "mean friction", "refused", "no stroke is without friction", 0,
                               [=] { return signals::frictionTrace(record(480, 0), "bench").mean; }));
    cases.push_back(signalCase("a record of 7 samples", "mean friction", "refused", "no texture fits", 0,
                               [=] { return signals::frictionTrace(record(7, 0.5), "bench").mean; }));
    cases.push_back(signalCase("a record with NaN", "mean friction", "refused", noNumber, 0,
                               [=] { return signals::frictionTrace(record(480, notANumber), "bench").mean; }));
}

rendering::Sources reliefOf(const cv::Mat& relief, double friction)
{
    rendering::Sources sources;
    sources.relief = relief;
    sources.meanFriction = friction;
    return sources;
}

/// The grey level in the middle of the display, with the range of this image alone.
double levelOf(const rendering::Sources& sources)
{
    const auto map = rendering::compose(protocols::conditionNamed("h&f"), sources, rendering::DisplayScale::Pixels);
    rendering::MapRange range;
    range.include(map);
    return rendering::mapToDisplay(map, range).at<unsigned char>(rendering::displayHeightPx / 2, rendering::displayWidthPx / 2);
}

void addImages(Cases& cases)
{
    const char* constant = "a constant image has no range: 0";
    cases.push_back(signalCase("a relief of 1 pixel", "grey level", "0", constant, 16,
                               [] { return levelOf(reliefOf(cv::Mat(1, 1, CV_32FC1, cv::Scalar(0.3)), 0.5)); }));
    cases.push_back(signalCase("a relief under no friction", "grey level", "0", constant, 16, [] {
        cv::Mat relief(40, 40, CV_32FC1);
        cv::RNG(3).fill(relief, cv::RNG::UNIFORM, 0, 1);
        return levelOf(reliefOf(relief, 0));
    }));
    cases.push_back(signalCase("a relief with NaN", "grey level", "refused", noNumber, 0,
                               [] { return levelOf(reliefOf(cv::Mat(40, 40, CV_32FC1, cv::Scalar(notANumber)), 0.5)); }));
    cases.push_back(signalCase("a relief of 1e31", "grey level", "refused", "beyond 1e30", 0,
                               [] { return levelOf(reliefOf(cv::Mat(40, 40, CV_32FC1, cv::Scalar(1e31)), 0.5)); }));
    cases.push_back(signalCase("a flat surface", "roughness Sq, mm", "0", "nothing varies", 16,
                               [] { return signals::roughnessOf(cv::Mat(16, 16, CV_32FC1, cv::Scalar(0.2)), {}).sqMm; }));
    cases.push_back(signalCase("a finger on 1 black pixel", "force, N", "0.15", "0.5 N x the friction of the glass, 0.3", 15,
                               [] { return rendering::strokeForce(cv::Mat(1, 1, CV_8UC1, cv::Scalar(0)), 0, false).front(); }));
}

}  // namespace

Cases extremeSignals()
{
    Cases cases;
    for (const auto add : {addIntegration, addPhotographs, addTraces, addImages}) add(cases);
    return cases;
}

}  // namespace study::bench
