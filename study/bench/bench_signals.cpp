#include "study/bench/bench_signals.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <numbers>
#include <opencv2/core.hpp>

#include "protocols/random.h"
#include "rendering/signals/cosine_transform.h"
#include "rendering/signals/shape_from_shading.h"
#include "rendering/signals/spectrogram.h"
#include "rendering/signals/surface_integration.h"
#include "rendering/signals/tactile/photometric_stereo.h"
#include "rendering/signals/tactile/slope_map_fit.h"
#include "study/bench/bench_composition.h"
#include "study/bench/median_time.h"

namespace study::bench {

namespace {

namespace signals = rendering::signals;

constexpr double pitchMm = 0.05;
constexpr int repeats = 21;

/// Median of several runs, after one run that fills the caches. Long work is repeated less often.
double medianMilliseconds(const std::function<void()>& work)
{
    return bench::medianMilliseconds(millisecondsOf(work) > 50 ? 3 : repeats, work);
}

struct KnownSurface {
    cv::Mat heightMm;  ///< CV_64FC1
    signals::Slopes slopes;
};

/// A plain weave of 0.8 mm yarns on a gentle wave of 9 mm, with its exact slopes.
KnownSurface knownWeave(int rows, int columns, double waveMm = 0.1)
{
    KnownSurface known{cv::Mat(rows, columns, CV_64FC1), {cv::Mat(rows, columns, CV_64FC1), cv::Mat(rows, columns, CV_64FC1)}};
    const double yarn = 2 * std::numbers::pi / 0.8, wave = 2 * std::numbers::pi / 9.0;
    for (int i = 0; i < rows; ++i)
        for (int j = 0; j < columns; ++j) {
            const double x = j * pitchMm, y = i * pitchMm;
            known.heightMm.at<double>(i, j) =
                0.05 * std::cos(yarn * x) * std::cos(yarn * y) + waveMm * std::sin(wave * (x + 0.4 * y));
            known.slopes.x.at<double>(i, j) =
                -0.05 * yarn * std::sin(yarn * x) * std::cos(yarn * y) + waveMm * wave * std::cos(wave * (x + 0.4 * y));
            known.slopes.y.at<double>(i, j) =
                -0.05 * yarn * std::cos(yarn * x) * std::sin(yarn * y) + 0.4 * waveMm * wave * std::cos(wave * (x + 0.4 * y));
        }
    return known;
}

cv::Mat centred(const cv::Mat& values)
{
    cv::Mat result;
    values.convertTo(result, CV_64F);
    return result - cv::mean(result)[0];
}

/// RMS difference in percent of the true surface's RMS height, both about their means.
double percentOfSq(const cv::Mat& found, const cv::Mat& known)
{
    return 100 * cv::norm(centred(found), centred(known)) / cv::norm(centred(known));
}

double correlation(const cv::Mat& a, const cv::Mat& b)
{
    const cv::Mat x = centred(a), y = centred(b);
    return x.dot(y) / (cv::norm(x) * cv::norm(y));
}

void benchIntegration(std::vector<BenchRow>& rows, int height, int width)
{
    using signals::IntegrationQuality;
    const auto known = knownWeave(height, width);
    signals::Slopes single;
    known.slopes.x.convertTo(single.x, CV_32F);
    known.slopes.y.convertTo(single.y, CV_32F);
    for (const auto quality : {IntegrationQuality::Full, IntegrationQuality::Fast}) {
        cv::Mat found;
        const double time = medianMilliseconds([&] {
            found = signals::integrate(quality == IntegrationQuality::Full ? known.slopes : single, {pitchMm, pitchMm},
                                       signals::SlopeKind::Point, quality);
        });
        rows.push_back({"integration " + std::to_string(height) + "x" + std::to_string(width),
                        quality == IntegrationQuality::Full ? "full" : "fast", time, percentOfSq(found, known.heightMm),
                        "% of Sq", "exact slopes of a weave; 64 or 32 bits"});
    }
}

/// The transforms alone, ours and OpenCV's. An integration needs one forward and one inverse transform.
void benchTransforms(std::vector<BenchRow>& rows)
{
    cv::Mat values;
    knownWeave(480, 640).heightMm.convertTo(values, CV_32F);
    cv::Mat back;
    const double ours = medianMilliseconds([&] { back = signals::inverseCosineTransform(signals::cosineTransform(values)); });
    rows.push_back({"cosine transforms 480x640", "ours", ours, cv::norm(back, values, cv::NORM_INF), "mm, largest",
                    "pocketfft, 32 bits, forward and inverse"});
    const double theirs = medianMilliseconds([&] {
        cv::Mat spectrum;
        cv::dct(values, spectrum);
        cv::idct(spectrum, back);
    });
    rows.push_back({"cosine transforms 480x640", "OpenCV", theirs, cv::norm(back, values, cv::NORM_INF), "mm, largest",
                    "cv::dct and cv::idct on the same image"});
}

/// Three lamps 120 degrees apart. The change of colour is exact except for the rounding to 8 bits.
signals::Calibration threeLamps(cv::Matx<float, 3, 2>& colourFromSlope)
{
    constexpr double gain = 0.4;
    signals::Calibration calibration;
    signals::LinearMap map{{std::vector<double>(3), std::vector<double>(3)}, {}};
    for (int lamp = 0; lamp < 3; ++lamp) {
        const double angle = 2 * std::numbers::pi * lamp / 3, c = std::cos(angle), s = std::sin(angle);
        colourFromSlope(lamp, 0) = static_cast<float>(-gain * c);
        colourFromSlope(lamp, 1) = static_cast<float>(-gain * s);
        map.gain[0][static_cast<std::size_t>(lamp)] = -2 * c / (3 * gain);
        map.gain[1][static_cast<std::size_t>(lamp)] = -2 * s / (3 * gain);
    }
    calibration.map = map;
    calibration.mmPerPixel = pitchMm;
    calibration.highPassCutoffMm = 3;
    return calibration;
}

/// A map of another kind, fitted to the light of the frame and its true slopes.
signals::SlopeMap fittedMap(const KnownSurface& known, const cv::Mat& frame, const cv::Mat& reference,
                            signals::MapQuality quality)
{
    signals::Slopes slopes;
    known.slopes.x.convertTo(slopes.x, CV_32F);
    known.slopes.y.convertTo(slopes.y, CV_32F);
    signals::SlopeSamples samples;
    samples.add(signals::lightOf(frame, reference, signals::LightMeasure::AgainstReference), slopes,
                cv::Mat(frame.size(), CV_8UC1, cv::Scalar(255)), 4);
    signals::FitOptions options;
    options.quality = quality;
    options.degree = 4;  // the degree that presses of a ball are fitted with
    return signals::fitSlopeMap(samples, options);
}

void benchPhotometricStereo(std::vector<BenchRow>& rows)
{
    using signals::IntegrationQuality;
    using signals::MapQuality;
    const auto known = knownWeave(240, 320);
    cv::Matx<float, 3, 2> colourFromSlope;
    auto calibration = threeLamps(colourFromSlope);
    cv::Mat both, change, frame;
    cv::merge(std::vector<cv::Mat>{known.slopes.x, known.slopes.y}, both);
    both.convertTo(both, CV_32F);
    cv::transform(both, change, colourFromSlope);
    change.convertTo(frame, CV_8U, 255, 128);
    const cv::Mat reference(frame.size(), CV_8UC3, cv::Scalar::all(128));
    const cv::Mat truth =
        signals::zeroedRelief(known.heightMm, {pitchMm, pitchMm}, calibration.highPassCutoffMm, calibration.zeroPercentile);
    const auto add = [&](const char* quality, IntegrationQuality integration, const char* note) {
        cv::Mat found;
        const double time =
            medianMilliseconds([&] { found = signals::heightFromFrame(frame, reference, calibration, integration); });
        rows.push_back({"photometric stereo 240x320", quality, time, percentOfSq(found, truth), "% of Sq",
                        std::string("8-bit frame of a weave to height, high-passed at 3 mm; ") + note});
    };
    add("fast", IntegrationQuality::Fast, "linear map, 32 bits");
    add("full", IntegrationQuality::Full, "linear map, 64 bits; at most 8 ms");
    calibration.map = fittedMap(known, frame, reference, MapQuality::Balanced);
    add("balanced", IntegrationQuality::Full, "polynomial map; at most 8 ms");
    calibration.map = fittedMap(known, frame, reference, MapQuality::Accurate);
    add("accurate", IntegrationQuality::Full, "network");
}

void benchShapeFromShading(std::vector<BenchRow>& rows)
{
    using signals::ShadingQuality;
    const auto known = knownWeave(512, 512, 0);
    const double azimuth = 60 * std::numbers::pi / 180, slant = 45 * std::numbers::pi / 180;
    const double lx = std::cos(azimuth) * std::sin(slant), ly = -std::sin(azimuth) * std::sin(slant), lz = std::cos(slant);
    cv::Mat photograph(known.heightMm.size(), CV_8UC1);
    for (int i = 0; i < photograph.rows; ++i)
        for (int j = 0; j < photograph.cols; ++j) {
            const double p = known.slopes.x.at<double>(i, j), q = known.slopes.y.at<double>(i, j);
            const double light = (lz - p * lx - q * ly) / std::sqrt(1 + p * p + q * q);
            photograph.at<unsigned char>(i, j) = cv::saturate_cast<unsigned char>(200 * light);
        }
    const cv::Mat truth = known.heightMm;
    for (const auto quality : {ShadingQuality::Accurate, ShadingQuality::Fast}) {
        signals::ShadingOptions options;
        options.quality = quality;
        cv::Mat found;
        const double time = medianMilliseconds([&] { found = signals::shapeFromShading(photograph, options); });
        rows.push_back({"shape from shading 512x512", quality == ShadingQuality::Accurate ? "accurate" : "fast", time,
                        1 - std::abs(correlation(found, truth)), "1 - |r|", "Lambertian weave, light's direction estimated"});
    }
    signals::ShadingOptions options;
    options.method = signals::ShadingMethod::GaussianBumps;
    cv::Mat found;
    const double time = medianMilliseconds([&] { found = signals::shapeFromShading(photograph, options); });
    rows.push_back({"shape from shading 512x512", "bumps", time, 1 - std::abs(correlation(found, truth)), "1 - |r|",
                    "Gaussian bumps, the paper's reference"});
}

std::vector<double> knownTrace()
{
    protocols::Random random(7);
    std::vector<double> trace(480);
    for (std::size_t i = 0; i < trace.size(); ++i) {
        const double mm = static_cast<double>(i) * 5 / 60;
        trace[i] = 0.5 + 0.03 * std::sin(2 * std::numbers::pi * mm / 0.8) + 0.02 * std::sin(2 * std::numbers::pi * mm / 7) +
                   0.005 * random.normal();
    }
    return trace;
}

/// Mean absolute difference in percent of the mean.
double percentOfMean(const std::vector<double>& found, const std::vector<double>& known)
{
    double sum = 0, mean = 0;
    for (std::size_t i = 0; i < known.size(); ++i) {
        sum += std::abs(found[i] - known[i]);
        mean += known[i];
    }
    return 100 * sum / mean;
}

void benchSpectrogram(std::vector<BenchRow>& rows)
{
    using signals::InversionQuality;
    const auto trace = knownTrace();
    const auto spectrogram = signals::stft(trace);
    std::vector<double> back;
    const double exact = medianMilliseconds([&] { back = signals::istft(signals::stft(trace)); });
    rows.push_back({"spectrogram and back", "complex", exact, percentOfMean(back, trace), "% of mean", "480 samples"});
    const auto magnitude = signals::magnitude(spectrogram);
    for (const auto quality : {InversionQuality::Fast, InversionQuality::Accurate}) {
        const auto options = signals::GriffinLimOptions::of(quality);
        signals::Inversion inversion;
        const double time = medianMilliseconds([&] { inversion = signals::griffinLim(magnitude, options); });
        const int tenths = static_cast<int>(std::lround(10 * percentOfMean(inversion.trace, trace)));
        rows.push_back({"spectrogram inversion", quality == InversionQuality::Fast ? "fast" : "accurate", time,
                        100 * inversion.spectralConvergence, "% of magnitude",
                        std::to_string(options.iterations) +
                            " iterations; the magnitude has no phases, so the trace deviates by " + std::to_string(tenths / 10) +
                            "." + std::to_string(tenths % 10) + " % of its mean"});
    }
}

}  // namespace

std::vector<BenchRow> benchSignals()
{
    const int threads = cv::getNumThreads();
    cv::setNumThreads(1);
    std::vector<BenchRow> rows;
    benchIntegration(rows, 240, 320);
    benchIntegration(rows, 480, 640);
    benchTransforms(rows);
    benchPhotometricStereo(rows);
    benchShapeFromShading(rows);
    benchSpectrogram(rows);
    for (auto& row : benchComposition()) rows.push_back(std::move(row));
    cv::setNumThreads(threads);
    return rows;
}

}  // namespace study::bench
