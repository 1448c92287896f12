#include "study/bench/bench_recordings.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <regex>

#include "protocols/random.h"
#include "rendering/images/image_io.h"
#include "rendering/images/true_map.h"
#include "rendering/signals/roughness.h"
#include "rendering/signals/shape_from_shading.h"
#include "rendering/signals/tactile/ball_calibration.h"
#include "rendering/signals/tactile/photometric_stereo.h"
#include "rendering/signals/tactile/surface_calibration.h"
#include "study/bench/median_time.h"
#include "study/measuring/calibration_report.h"

namespace study::bench {

namespace {

namespace fs = std::filesystem;
namespace signals = rendering::signals;
using rendering::Decode;
using rendering::readPicture;
using rendering::readTrueMap;
using rendering::TrueMap;

constexpr double ballRadiusMm = 2.0, ballMmPerPixel = 0.1245;  ///< presses in taxim_gelsight
constexpr double grainCutoffPx = 400;  ///< longer waves of a normal map are the form of the object, not its grain
constexpr int grainPartPx = 2048;
constexpr double finePx = 1.5,
                 coarsePx = 40;  ///< widths of the Gaussians that band-limit shading and surface before they are compared

std::string text(const char* format, auto... values)
{
    char buffer[240];
    std::snprintf(buffer, sizeof buffer, format, values...);
    return buffer;
}

std::vector<fs::path> filesIn(const fs::path& folder, const std::string& pattern)
{
    const std::regex wanted(pattern, std::regex::icase);
    std::vector<fs::path> files;
    std::error_code failed;
    for (const auto& entry : fs::directory_iterator(folder, failed))
        if (std::regex_search(entry.path().filename().string(), wanted)) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

/// Subtracts the mean of the finite values. Other values become 0.
cv::Mat centredWhereFinite(const cv::Mat& values)
{
    cv::Mat result;
    values.convertTo(result, CV_64F);
    const cv::Mat finite = result - result == 0;  // a difference with itself is 0 unless the value is not finite
    result -= cv::mean(result, finite)[0];
    result.setTo(0, finite == 0);
    return result;
}

double rmsOf(const cv::Mat& centredValues, const cv::Mat& like)
{
    return cv::norm(centredValues) / std::sqrt(std::max(1.0, static_cast<double>(cv::countNonZero(like - like == 0))));
}

double sqOf(const cv::Mat& values) { return rmsOf(centredWhereFinite(values), values); }

/// Root mean square of the differences without their mean, over the places where the surface is known.
double rms(const cv::Mat& found, const cv::Mat& known)
{
    cv::Mat a, b;
    found.convertTo(a, CV_64F);
    known.convertTo(b, CV_64F);
    const cv::Mat difference = a - b;
    return rmsOf(centredWhereFinite(difference), difference);
}

double correlationWhereFinite(const cv::Mat& a, const cv::Mat& b)
{
    const cv::Mat x = centredWhereFinite(a), y = centredWhereFinite(b);
    return x.dot(y) / (cv::norm(x) * cv::norm(y));
}

/// numpy.gradient: central differences, one-sided at the borders.
cv::Mat differencesAlongX(const cv::Mat& height, double pitch)
{
    cv::Mat slopes(height.size(), CV_64FC1);
    for (int i = 0; i < height.rows; ++i)
        for (int j = 0; j < height.cols; ++j) {
            const int a = std::max(0, j - 1), b = std::min(height.cols - 1, j + 1);  // NaN beside a missing point
            slopes.at<double>(i, j) = (height.at<double>(i, b) - height.at<double>(i, a)) / (std::max(1, b - a) * pitch);
        }
    return slopes;
}

cv::Mat noisy(const cv::Mat& slopes, double share, protocols::Random& random)
{
    cv::Mat result = slopes.clone();
    const double spread = share * sqOf(slopes);
    for (double& value : cv::Mat_<double>(result)) value += spread * random.normal();
    return result;
}

struct DifferencedMap {
    cv::Mat heightMm;
    signals::Slopes slopes;
    signals::Pitch pitch;
};

DifferencedMap differenced(const TrueMap& map)
{
    DifferencedMap result;
    map.heightMm.convertTo(result.heightMm, CV_64F);
    result.pitch = {map.xPitchMm, map.yPitchMm};
    result.slopes = {differencesAlongX(result.heightMm, map.xPitchMm), differencesAlongX(result.heightMm.t(), map.yPitchMm).t()};
    return result;
}

/// Fills missing points smoothly.
cv::Mat integrated(const signals::Slopes& slopes, const signals::Pitch& pitch, signals::SlopeKind kind)
{
    const bool whole = cv::checkRange(slopes.x) && cv::checkRange(slopes.y);
    return whole ? signals::integrate(slopes, pitch, kind) : signals::integrateAround(slopes, {}, pitch, kind);
}

/// The same differences without a border of 8 % of each side: nothing measured joins the four lattices of central differences.
BenchRow withoutBorder(const DifferencedMap& map, const std::string& stage)
{
    const cv::Size size = map.heightMm.size();
    const cv::Rect inner(size.width * 2 / 25, size.height * 2 / 25, size.width - 2 * (size.width * 2 / 25),
                         size.height - 2 * (size.height * 2 / 25));
    cv::Mat measured(size, CV_8UC1, cv::Scalar(0));
    measured(inner) = 255;
    cv::Mat height;
    const double time =
        millisecondsOf([&] { height = signals::integrateAround(map.slopes, measured, map.pitch, signals::SlopeKind::Central); });
    const cv::Mat known = map.heightMm(inner);
    return {stage,
            "border missing",
            time,
            100 * rms(height(inner), known) / sqOf(known),
            "% of Sq",
            text("%.0f %% of the points are missing; required at most 0.1",
                 100 - 100.0 * static_cast<double>(inner.area()) / static_cast<double>(size.area()))};
}

void addIntegration(std::vector<BenchRow>& rows, const fs::path& file)
{
    const auto map = differenced(readTrueMap(file));
    const std::string stage = "integrate " + file.stem().string();
    cv::Mat height;
    const double time = millisecondsOf([&] { height = integrated(map.slopes, map.pitch, signals::SlopeKind::Central); });
    const std::string size = text("%d x %d, central differences integrated as such; required at most 1, aim 0.1",
                                  map.heightMm.cols, map.heightMm.rows);
    rows.push_back({stage, "full", time, 100 * rms(height, map.heightMm) / sqOf(map.heightMm), "% of Sq", size});
    protocols::Random random(1);
    const signals::Slopes rough{noisy(map.slopes.x, 0.02, random), noisy(map.slopes.y, 0.02, random)};
    height = integrated(rough, map.pitch, signals::SlopeKind::Central);
    rows.push_back({stage, "2 % noise", time, 100 * rms(height, map.heightMm) / sqOf(map.heightMm), "% of Sq",
                    "noise of 2 % of the slopes' RMS on each"});
    rows.push_back(withoutBorder(map, stage));
    height = integrated(map.slopes, map.pitch, signals::SlopeKind::Point);
    rows.push_back({stage, "as point", time, 100 * rms(height, map.heightMm) / sqOf(map.heightMm), "% of Sq",
                    "the same differences treated as point slopes: the error of a wrong kind"});
}

void addMaps(RecordingsBench& bench, const fs::path& folder)
{
    const auto files = filesIn(folder / "truemap_heightmaps", "\\.tmd$");
    if (files.empty()) bench.skipped.push_back((folder / "truemap_heightmaps").string() + ": no .tmd");
    for (const auto& file : files) addIntegration(bench.rows, file);
}

signals::KnownSurfaceFrame grooveFrame(const std::vector<fs::path>& photographs, const TrueMap& map, const Decode& decodeOther)
{
    std::vector<cv::Mat> lamps;
    for (const auto& file : photographs) {
        cv::Mat lamp = readPicture(file, decodeOther);
        if (lamp.channels() == 3) cv::cvtColor(lamp, lamp, cv::COLOR_RGB2GRAY);
        lamps.push_back(lamp);
    }
    return {signals::oneFrame(lamps), {}, map.heightMm, {map.xPitchMm, map.yPitchMm}};
}

cv::Mat inBand(const cv::Mat& image)
{
    cv::Mat values, fine, coarse;
    image.convertTo(values, CV_64F);
    cv::GaussianBlur(values, fine, {}, finePx, 0, cv::BORDER_REFLECT);
    cv::GaussianBlur(values, coarse, {}, coarsePx, 0, cv::BORDER_REFLECT);
    return fine - coarse;
}

void addShading(std::vector<BenchRow>& rows, const fs::path& file, const cv::Mat& heightMm, const Decode& decodeOther)
{
    const cv::Mat photograph = readPicture(file, decodeOther);
    if (photograph.size() != heightMm.size()) return;
    const auto light = signals::estimateLight(photograph);
    for (const auto method : {signals::ShadingMethod::Linear, signals::ShadingMethod::GaussianBumps}) {
        signals::ShadingOptions options;
        options.method = method;
        cv::Mat relief;
        const double time = millisecondsOf([&] { relief = signals::shapeFromShading(photograph, options); });
        const double r = correlationWhereFinite(inBand(relief), inBand(heightMm));
        rows.push_back({"shading " + file.stem().string(), method == signals::ShadingMethod::Linear ? "linear" : "bumps", time,
                        std::abs(r), "|r| with the height",
                        text("between Gaussians of 1.5 and 40 px; light estimated at %.0f deg; required 0.6, aim 0.75 (linear)",
                             light.azimuthDeg)});
    }
}

void addGroove(RecordingsBench& bench, const fs::path& folder, const Decode& decodeOther)
{
    const fs::path scan = folder / "gsmatlab_groove";
    const auto maps = filesIn(scan, "\\.tmd$"), photographs = filesIn(scan, "\\.(png|jpe?g)$");
    if (maps.empty()) {
        bench.skipped.push_back(scan.string() + ": no .tmd");
        return;
    }
    const auto map = readTrueMap(maps.front());
    const auto differences = differenced(map);
    for (const auto kind : {signals::SlopeKind::Central, signals::SlopeKind::Point}) {
        cv::Mat height;
        const double time = millisecondsOf([&] { height = signals::integrate(differences.slopes, differences.pitch, kind); });
        bench.rows.push_back({"integrate groove", kind == signals::SlopeKind::Central ? "central" : "point", time,
                              1000 * rms(height, differences.heightMm), "um RMSE",
                              "differences of the vendor's map; required at most 0.3"});
    }
    if (photographs.size() < 3) {
        bench.skipped.push_back(scan.string() + ": fewer than three photographs");
        return;
    }
    const auto surface = grooveFrame(photographs, map, decodeOther);
    const int half = map.heightMm.rows / 2;
    for (const auto quality : {signals::MapQuality::Fast, signals::MapQuality::Balanced, signals::MapQuality::Accurate}) {
        signals::SurfaceScore score;
        const double time = millisecondsOf([&] {
            score = signals::scoreOf(signals::calibrationFrom(surface, 0, half, quality), surface, half, map.heightMm.rows);
        });
        bench.rows.push_back(
            {"groove from photographs", measuring::nameOf(quality), time, 1000 * score.heightErrorMm, "um RMSE",
             text("fitted on the top half, tested on the bottom half, without a quadratic; slopes differ by %.4f; "
                  "required at most 12.5, aim 8 (balanced)",
                  score.slopeError)});
    }
    for (const auto& photograph : photographs) addShading(bench.rows, photograph, map.heightMm, decodeOther);
}

void addPresses(RecordingsBench& bench, const fs::path& folder, const Decode& decodeOther)
{
    const fs::path place = folder / "taxim_gelsight";
    if (filesIn(place, "^background\\.").empty()) {
        bench.skipped.push_back(place.string() + ": no background");
        return;
    }
    const auto presses = rendering::readBallPresses(place, ballRadiusMm, ballMmPerPixel, decodeOther);
    const auto located = signals::locate(presses);
    for (const auto quality : {signals::MapQuality::Fast, signals::MapQuality::Balanced, signals::MapQuality::Accurate}) {
        const auto trade = measuring::tradeOf(presses, located, quality);
        const auto& score = trade.score;
        const std::string note = text("%zu presses, cross-validated; contact found at %.1f px; fitted in %.2f s",
                                      presses.presses.size(), located.contactPx, trade.fitSeconds);
        bench.rows.push_back({"ball presses, normals", measuring::nameOf(quality), trade.millisecondsAFrame, score.normalErrorDeg,
                              "deg, median", note + "; required at most 7, aim 6 (balanced)"});
        bench.rows.push_back({"ball presses, depth", measuring::nameOf(quality), trade.millisecondsAFrame, score.depthErrorMm,
                              "mm in contact", "required at most 0.095, aim 0.07 (balanced)"});
        bench.rows.push_back({"ball presses, peak", measuring::nameOf(quality), trade.millisecondsAFrame, score.peakMm,
                              "mm (1.0 pressed)",
                              text("%.2f to %.2f; with the gel's bridge around contact %.2f; required 1.0 +- 0.2, aim 0.15",
                                   score.lowestPeakMm, score.highestPeakMm, score.peakOverGelMm)});
    }
}

/// Discs of 2 to 23 pixels without slopes, one for every 7,000 pixels.
signals::Slopes withHoles(const signals::Slopes& slopes)
{
    protocols::Random random(1);
    const auto drawn = [&](int below) { return static_cast<int>(random.below(static_cast<std::uint64_t>(below))); };
    cv::Mat holes = cv::Mat::zeros(slopes.x.size(), CV_8UC1);
    for (std::size_t k = 0; k < holes.total() / 7000; ++k)
        cv::circle(holes, {drawn(holes.cols), drawn(holes.rows)}, 2 + drawn(22), cv::Scalar(255), cv::FILLED);
    signals::Slopes result{slopes.x.clone(), slopes.y.clone()};
    result.x.setTo(std::numeric_limits<double>::quiet_NaN(), holes);
    result.y.setTo(std::numeric_limits<double>::quiet_NaN(), holes);
    return result;
}

void addGrain(RecordingsBench& bench, const fs::path& folder, const Decode& decodeOther)
{
    const auto files = filesIn(folder / "gelsight_wear_surfaces", "S\\d+.*normalmap");
    if (files.empty())
        bench.skipped.push_back((folder / "gelsight_wear_surfaces").string() + ": no normal map of abrasive paper");
    std::vector<std::pair<double, double>> byGrit;
    for (const auto& file : files) {
        std::smatch grit;
        const std::string name = file.filename().string();
        std::regex_search(name, grit, std::regex("S(\\d+)"));
        const auto slopes = signals::slopesFromNormals(readPicture(file, decodeOther));
        cv::Mat height;
        const double time = millisecondsOf([&] { height = signals::integrateAround(slopes, {}, {}); });
        const cv::Size part(std::min(grainPartPx, height.cols), std::min(grainPartPx, height.rows));
        const cv::Mat middle =
            height(cv::Rect((height.cols - part.width) / 2, (height.rows - part.height) / 2, part.width, part.height));
        const double length = signals::autocorrelationLengthMm(signals::withoutLowFrequency(middle, {}, grainCutoffPx), {});
        byGrit.emplace_back(std::stod(grit[1]), length);  // a file name is too short for a number that no double holds
        const auto holed = withHoles(slopes);
        cv::Mat around;
        const double timeOfHoled = millisecondsOf([&] { around = signals::integrateAround(holed, {}, {}); });
        bench.rows.push_back(
            {"grain " + name.substr(0, 24), "gaps", timeOfHoled, 100 * rms(around, height) / sqOf(height), "% of Sq",
             text("%.1f %% of the slopes missing in discs; difference from the whole map; required at most 10 s",
                  100 - 100.0 * cv::countNonZero(signals::measuredPlaces(holed)) / static_cast<double>(height.total()))});
        bench.rows.push_back(
            {"grain " + name.substr(0, 24), "full", time, length, "px to 0.2",
             text("autocorrelation length; %d x %d, waves over %.0f px out", height.cols, height.rows, grainCutoffPx)});
    }
    std::sort(byGrit.begin(), byGrit.end());
    const bool inOrder =
        std::is_sorted(byGrit.begin(), byGrit.end(), [](const auto& a, const auto& b) { return a.second >= b.second; });
    if (byGrit.size() > 1)
        bench.rows.push_back({"grain order", "full", 0, inOrder ? 0.0 : 1.0, "out of order",
                              inOrder ? "coarser paper has longer waves" : "the lengths do not decrease with the grit"});
}

}  // namespace

RecordingsBench benchRecordings(const fs::path& folder, const Decode& decodeOther,
                                const std::function<void(const std::string& part)>& begins)
{
    RecordingsBench bench;
    const auto part = [&](const char* name, const auto& add) {
        if (begins) begins(std::string("recordings: ") + name);
        add();
    };
    part("height maps", [&] { addMaps(bench, folder); });
    part("groove", [&] { addGroove(bench, folder, decodeOther); });
    part("ball presses", [&] { addPresses(bench, folder, decodeOther); });
    part("normal maps", [&] { addGrain(bench, folder, decodeOther); });
    return bench;
}

}  // namespace study::bench
