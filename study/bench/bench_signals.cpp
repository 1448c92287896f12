#include "study/bench/bench_signals.h"

#include <algorithm>
#include <chrono>
#include <cmath>
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
#include "study/bench/bench_turns.h"

namespace study::bench {

namespace {

namespace signals = rendering::signals;

constexpr double pitchMm = 0.05;
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

void add(std::vector<BenchRow>& rows, const std::vector<TimedSetting>& settings)
{
    for (BenchRow& row : benchInTurns(settings)) rows.push_back(std::move(row));
}

signals::Slopes inSinglePrecision(const signals::Slopes& slopes)
{
    signals::Slopes single;
    slopes.x.convertTo(single.x, CV_32F);
    slopes.y.convertTo(single.y, CV_32F);
    return single;
}

void benchIntegration(std::vector<BenchRow>& rows, int height, int width)
{
    using signals::IntegrationQuality;
    const auto known = knownWeave(height, width);
    const auto single = inSinglePrecision(known.slopes);
    cv::Mat found;
    const auto setting = [&](const char* name, const signals::Slopes& slopes, IntegrationQuality quality) {
        return TimedSetting{{"integration " + std::to_string(height) + "x" + std::to_string(width),
                             name,
                             {},
                             {},
                             "% of Sq",
                             "exact slopes of a weave; 64 or 32 bits"},
                            [&found, &slopes, quality] {
                                found = signals::integrate(slopes, {pitchMm, pitchMm}, signals::SlopeKind::Point, quality);
                            },
                            [&] { return percentOfSq(found, known.heightMm); }};
    };
    add(rows, {setting("full", known.slopes, IntegrationQuality::Full), setting("fast", single, IntegrationQuality::Fast)});
}

/// The transforms alone, ours and OpenCV's. An integration needs one forward and one inverse transform.
void benchTransforms(std::vector<BenchRow>& rows)
{
    cv::Mat values, back;
    knownWeave(480, 640).heightMm.convertTo(values, CV_32F);
    const auto error = [&] { return cv::norm(back, values, cv::NORM_INF); };
    add(rows, {{{"cosine transforms 480x640", "ours", {}, {}, "mm, largest", "pocketfft, 32 bits, forward and inverse"},
                [&] { back = signals::inverseCosineTransform(signals::cosineTransform(values)); },
                error},
               {{"cosine transforms 480x640", "OpenCV", {}, {}, "mm, largest", "cv::dct and cv::idct on the same image"},
                [&] {
                    cv::Mat spectrum;
                    cv::dct(values, spectrum);
                    cv::idct(spectrum, back);
                },
                error}});
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

/// A frame of a weave under the three lamps, of 8 bits.
struct KnownFrame {
    KnownSurface surface;
    cv::Mat frame, reference;
};

KnownFrame frameOf(KnownSurface surface, const cv::Matx<float, 3, 2>& colourFromSlope)
{
    KnownFrame known;
    cv::Mat both, change;
    cv::merge(std::vector<cv::Mat>{surface.slopes.x, surface.slopes.y}, both);
    both.convertTo(both, CV_32F);
    cv::transform(both, change, colourFromSlope);
    change.convertTo(known.frame, CV_8U, 255, 128);
    known.reference = cv::Mat(known.frame.size(), CV_8UC3, cv::Scalar::all(128));
    known.surface = std::move(surface);
    return known;
}

/// A map of another kind, fitted to the light of the frame and its true slopes.
signals::SlopeMap fittedMap(const KnownFrame& known, signals::MapQuality quality)
{
    signals::SlopeSamples samples;
    samples.add(signals::lightOf(known.frame, known.reference, signals::LightMeasure::AgainstReference),
                inSinglePrecision(known.surface.slopes), cv::Mat(known.frame.size(), CV_8UC1, cv::Scalar(255)), 4);
    signals::FitOptions options;
    options.quality = quality;
    options.degree = 4;  // the degree that presses of a ball are fitted with
    return signals::fitSlopeMap(samples, options);
}

/// Root mean square error of both slopes, in percent of that of the slopes themselves.
double percentOfSlopes(const signals::Slopes& found, const signals::Slopes& known)
{
    const auto single = inSinglePrecision(known);
    return 100 * std::hypot(cv::norm(found.x, single.x), cv::norm(found.y, single.y)) /
           std::hypot(cv::norm(single.x), cv::norm(single.y));
}

/// Maps are fitted to one weave and tried on a weave that was not fitted.
void benchCalibration(std::vector<BenchRow>& rows)
{
    using signals::MapQuality;
    cv::Matx<float, 3, 2> colourFromSlope;
    auto calibration = threeLamps(colourFromSlope);
    const KnownFrame fitted = frameOf(knownWeave(240, 320), colourFromSlope),
                     unseen = frameOf(knownWeave(240, 320, 0.2), colourFromSlope);
    const auto setting = [&](const char* name, MapQuality quality, const char* note) {
        return TimedSetting{{"calibration 240x320", name, {}, {}, "% of slopes, unseen frame", note},
                            [&, quality] { calibration.map = fittedMap(fitted, quality); },
                            [&] {
                                return percentOfSlopes(signals::slopesFromFrame(unseen.frame, unseen.reference, calibration),
                                                       unseen.surface.slopes);
                            }};
    };
    // The network takes seconds, so this stage may end after one round.
    for (BenchRow& row : benchInTurns(
             {setting("fast", MapQuality::Fast, "linear map"), setting("balanced", MapQuality::Balanced, "polynomial map"),
              setting("accurate", MapQuality::Accurate, "network")},
             {21, 1500, 1}))
        rows.push_back(std::move(row));
}

void benchPhotometricStereo(std::vector<BenchRow>& rows)
{
    using signals::IntegrationQuality;
    using signals::MapQuality;
    cv::Matx<float, 3, 2> colourFromSlope;
    const auto linear = threeLamps(colourFromSlope);
    const KnownFrame known = frameOf(knownWeave(240, 320), colourFromSlope);
    const cv::Mat truth =
        signals::zeroedRelief(known.surface.heightMm, {pitchMm, pitchMm}, linear.highPassCutoffMm, linear.zeroPercentile);
    auto polynomial = linear, network = linear;
    polynomial.map = fittedMap(known, MapQuality::Balanced);
    network.map = fittedMap(known, MapQuality::Accurate);
    cv::Mat found;
    const auto setting = [&](const char* name, const signals::Calibration& calibration, IntegrationQuality quality,
                             const char* note) {
        return TimedSetting{
            {"photometric stereo 240x320",
             name,
             {},
             {},
             "% of Sq",
             std::string("8-bit frame of a weave to height, high-passed at 3 mm; ") + note},
            [&, quality] { found = signals::heightFromFrame(known.frame, known.reference, calibration, quality); },
            [&] { return percentOfSq(found, truth); }};
    };
    add(rows, {setting("fast", linear, IntegrationQuality::Fast, "linear map, 32 bits"),
               setting("full", linear, IntegrationQuality::Full, "linear map, 64 bits; at most 8 ms"),
               setting("balanced", polynomial, IntegrationQuality::Full, "polynomial map; at most 8 ms"),
               setting("accurate", network, IntegrationQuality::Full, "network")});
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
    cv::Mat found;
    const auto setting = [&](const char* name, const char* note, signals::ShadingMethod method, ShadingQuality quality) {
        signals::ShadingOptions options;
        options.method = method;
        options.quality = quality;
        return TimedSetting{{"shape from shading 512x512", name, {}, {}, "1 - |r|", note},
                            [&, options] { found = signals::shapeFromShading(photograph, options); },
                            [&] { return 1 - std::abs(correlation(found, known.heightMm)); }};
    };
    const char* linear = "Lambertian weave, light's direction estimated";
    add(rows, {setting("accurate", linear, signals::ShadingMethod::Linear, ShadingQuality::Accurate),
               setting("fast", linear, signals::ShadingMethod::Linear, ShadingQuality::Fast),
               setting("bumps", "Gaussian bumps, the paper's reference", signals::ShadingMethod::GaussianBumps,
                       ShadingQuality::Accurate)});
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
    const auto trace = knownTrace();
    const auto spectrogram = signals::stft(trace);
    std::vector<double> back;
    add(rows, {{{"spectrogram and back", "complex", {}, {}, "% of mean", "480 samples"},
                [&] { back = signals::istft(signals::stft(trace)); },
                [&] { return percentOfMean(back, trace); }}});
    const auto magnitude = signals::magnitude(spectrogram);
    signals::Inversion inversion;
    std::vector<TimedSetting> settings;
    for (const int iterations : {4, 8, 16, 32, 64, 100, 200, 400})
        settings.push_back({{"spectrogram inversion",
                             std::to_string(iterations) + " iterations",
                             {},
                             {},
                             "% of magnitude",
                             "the magnitude has no phases, so the trace itself may differ more"},
                            [&, iterations] {
                                signals::GriffinLimOptions options;
                                options.iterations = iterations;
                                inversion = signals::griffinLim(magnitude, options);
                            },
                            [&] { return 100 * inversion.spectralConvergence; }});
    add(rows, settings);
}

}  // namespace

double knownWeaveSqMm()
{
    const cv::Mat height = centred(knownWeave(480, 640).heightMm);
    return cv::norm(height) / std::sqrt(static_cast<double>(height.total()));
}

std::vector<BenchRow> benchSignals()
{
    const int threads = cv::getNumThreads();
    cv::setNumThreads(1);
    std::vector<BenchRow> rows;
    benchIntegration(rows, 240, 320);
    benchIntegration(rows, 480, 640);
    benchTransforms(rows);
    benchCalibration(rows);
    benchPhotometricStereo(rows);
    benchShapeFromShading(rows);
    benchSpectrogram(rows);
    for (auto& row : benchComposition()) rows.push_back(std::move(row));
    cv::setNumThreads(threads);
    return rows;
}

}  // namespace study::bench
