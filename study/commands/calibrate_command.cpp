// vis2hap calibrate PRESSES --ball-radius MM --mm-per-pixel X --out FILE, or FRAME... --surface HEIGHT --out FILE
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <numeric>
#include <opencv2/core.hpp>

#include "protocols/files/errors.h"
#include "protocols/files/folder_draft.h"
#include "protocols/files/safe_text.h"
#include "protocols/files/whole_file.h"
#include "rendering/images/image_io.h"
#include "rendering/images/true_map.h"
#include "rendering/signals/tactile/press_folder.h"
#include "rendering/signals/tactile/surface_calibration.h"
#include "study/commands/command_line.h"
#include "study/commands/parts/json_output.h"
#include "study/commands/parts/number_checks.h"
#include "study/looking/picture_decoder.h"
#include "study/measuring/calibration_report.h"

namespace study::commands {

namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;
using rendering::signals::MapQuality;

const std::map<std::string, MapQuality> qualities{
    {"fast", MapQuality::Fast}, {"balanced", MapQuality::Balanced}, {"accurate", MapQuality::Accurate}};

struct CalibrateCall {
    std::vector<std::string> from;
    std::string out, test, surface, background, quality = "balanced";
    double ballRadiusMm = 0, mmPerPixel = 0;
    std::vector<double> rows{0, 1};
    double cutoffMm = 0;
    JsonTarget json;
};

/// Path of a file in the folder of --out, with its name and another ending.
fs::path besideOut(const CalibrateCall& call, const std::string& ending)
{
    return fs::path(call.out).parent_path() / (fs::path(call.out).stem().string() + ending);
}

void writePictures(const CalibrateCall& call, const cv::Mat& reference, const cv::Mat& sheet)
{
    rendering::writePng(besideOut(call, "-background.png"), reference);
    rendering::writePng(besideOut(call, "-presses.png"), sheet);
}

void printScore(const char* of, const rendering::signals::CalibrationScore& score)
{
    std::printf(
        "%-28s median error of normals %.2f deg, error of depth in contact %.4f mm, peak %.2f mm (%.2f to %.2f); the circles "
        "give %.2f mm\n",
        of, score.normalErrorDeg, score.depthErrorMm, score.peakMm, score.lowestPeakMm, score.highestPeakMm, score.ballPeakMm);
}

void printTrade(const std::vector<measuring::QualityTrade>& trades, MapQuality chosen)
{
    std::printf("\n%-10s %12s %14s %10s %14s %8s\n", "quality", "normals deg", "depth err mm", "peak mm", "ms a frame", "fit s");
    for (const auto& trade : trades)
        std::printf("%-10s %12.2f %14.4f %10.3f %14.2f %8.2f%s\n", measuring::nameOf(trade.quality).c_str(),
                    trade.score.normalErrorDeg, trade.score.depthErrorMm, trade.score.peakMm, trade.millisecondsAFrame,
                    trade.fitSeconds, trade.quality == chosen ? "  <- saved" : "");
}

ordered_json tradeJson(const std::vector<measuring::QualityTrade>& trades)
{
    ordered_json rows = ordered_json::array();
    for (const auto& trade : trades)
        rows.push_back({{"quality", measuring::nameOf(trade.quality)},
                        {"normal_error_deg", trade.score.normalErrorDeg},
                        {"depth_error_mm", trade.score.depthErrorMm},
                        {"peak_mm", trade.score.peakMm},
                        {"ms_a_frame", trade.millisecondsAFrame},
                        {"fit_s", trade.fitSeconds}});
    return rows;
}

std::vector<std::size_t> allOf(const rendering::signals::BallPresses& presses)
{
    std::vector<std::size_t> all(presses.presses.size());
    std::iota(all.begin(), all.end(), 0);
    return all;
}

int calibrateOnBalls(const CalibrateCall& call)
{
    namespace signals = rendering::signals;
    const MapQuality quality = qualities.at(call.quality);
    const auto presses = rendering::readBallPresses(call.from.front(), call.ballRadiusMm, call.mmPerPixel, looking::decodeByQt);
    const auto located = signals::locate(presses);
    auto calibration = signals::calibrationFrom(presses, located.circles, allOf(presses), quality);
    if (call.cutoffMm > 0) calibration.highPassCutoffMm = call.cutoffMm;

    std::vector<measuring::QualityTrade> trades;
    for (const auto& [name, each] : qualities) trades.push_back(measuring::tradeOf(presses, located, each));
    std::sort(trades.begin(), trades.end(), [](const auto& a, const auto& b) { return a.quality < b.quality; });
    const auto& validated = trades[static_cast<std::size_t>(quality)].score;
    ordered_json report{{"schema", "vis2hap.calibration-report/1"},
                        {"presses", presses.presses.size()},
                        {"quality", call.quality},
                        {"ball_radius_mm", call.ballRadiusMm},
                        {"mm_per_pixel", call.mmPerPixel},
                        {"contact_radius_px", located.contactPx},
                        {"cross_validated", measuring::jsonOf(validated)},
                        {"trade", tradeJson(trades)}};
    std::optional<signals::CalibrationScore> tested;
    if (!call.test.empty()) {
        const auto others = rendering::readBallPresses(call.test, call.ballRadiusMm, call.mmPerPixel, looking::decodeByQt);
        tested = signals::scoreOf(calibration, others, signals::locate(others, located), allOf(others));
        report["test"] = measuring::jsonOf(*tested);
    }
    protocols::writeWholeFile(call.out, signals::toJson(calibration));
    writePictures(call, presses.background, measuring::pressSheet(presses, calibration, validated));
    protocols::writeWholeFile(besideOut(call, "-quality.json"), report.dump(2) + "\n");
    if (call.json) {
        writeJson(call.json, report);
        return 0;
    }
    std::printf("%zu presses; radius of contact %.1f px (%.2f mm)\n", presses.presses.size(), located.contactPx,
                located.contactPx * call.mmPerPixel);
    printScore("cross-validated:", validated);
    if (tested) printScore((call.test + ":").c_str(), *tested);
    std::printf("%-28s with the gel around the contact, which bends up to its rest surface, the peak is %.2f mm\n", "",
                validated.peakOverGelMm);
    printTrade(trades, quality);
    std::printf("\nwrote %s, %s, %s and %s\n", protocols::printable(call.out).c_str(), besideOut(call, "-background.png").c_str(),
                besideOut(call, "-presses.png").c_str(), besideOut(call, "-quality.json").c_str());
    return 0;
}

rendering::TrueMap knownSurface(const CalibrateCall& call)
{
    const fs::path file(call.surface);
    if (file.extension() == ".tmd") {
        auto map = rendering::readTrueMap(file);
        if (call.mmPerPixel > 0) map.xPitchMm = map.yPitchMm = call.mmPerPixel;
        return map;
    }
    if (!(call.mmPerPixel > 0))
        throw protocols::badInput({"the pitch of the surface is unknown", call.surface, "--mm-per-pixel", "state it"});
    const cv::Mat heightMm = rendering::readImage(file);
    if (heightMm.type() != CV_32FC1 && heightMm.type() != CV_64FC1)  // integers have no unit that is known
        throw protocols::badInput({"is a picture, and no map of heights in mm", call.surface,
                                   "one channel of floating-point numbers, as .tmd, .tiff or .npy",
                                   "export the heights in mm as 32-bit float"});
    return {heightMm, call.mmPerPixel, call.mmPerPixel, ""};
}

int calibrateOnSurface(const CalibrateCall& call)
{
    namespace signals = rendering::signals;
    std::vector<cv::Mat> frames;
    for (const auto& file : call.from) frames.push_back(rendering::readPicture(file, looking::decodeByQt));
    signals::KnownSurfaceFrame surface;
    surface.frame = frames.size() == 1 ? frames.front() : signals::oneFrame(frames);
    if (!call.background.empty()) surface.reference = rendering::readPicture(call.background, looking::decodeByQt);
    const auto map = knownSurface(call);
    surface.heightMm = map.heightMm;
    surface.pitch = {map.xPitchMm, map.yPitchMm};
    const auto row = [&](double share) { return static_cast<int>(std::lround(share * map.heightMm.rows)); };
    const int first = row(call.rows[0]), last = row(call.rows[1]);
    auto calibration = signals::calibrationFrom(surface, first, last, qualities.at(call.quality));
    if (call.cutoffMm > 0) calibration.highPassCutoffMm = call.cutoffMm;
    ordered_json report{{"schema", "vis2hap.calibration-report/1"}, {"quality", call.quality}, {"surface", call.surface}};
    const auto put = [&](const char* name, int from, int to) {
        if (from >= to) return;
        const auto score = signals::scoreOf(calibration, surface, from, to);
        report[name] = {{"rows", {from, to}},
                        {"slope_error", score.slopeError},
                        {"height_error_mm", score.heightErrorMm},
                        {"surface_sq_mm", score.knownSqMm}};
        if (!call.json)
            std::printf(
                "%-12s rows %d to %d: RMS error of slopes %.4f, of height %.2f um (without a quadratic surface); Sq %.1f um\n",
                name, from, to, score.slopeError, 1000 * score.heightErrorMm, 1000 * score.knownSqMm);
    };
    put("learned", first, last);
    put("above", 0, first);
    put("below", last, map.heightMm.rows);
    protocols::writeWholeFile(call.out, signals::toJson(calibration));
    if (call.json)
        writeJson(call.json, report);
    else
        std::printf("wrote %s\n", protocols::printable(call.out).c_str());
    return 0;
}

int calibrate(const CalibrateCall& call)
{
    protocols::makeFolders(fs::absolute(call.out).parent_path());
    if (!call.surface.empty()) return calibrateOnSurface(call);
    if (call.from.size() != 1)
        throw protocols::badInput({std::to_string(call.from.size()) + " folders of presses are named", call.from[1], "one folder",
                                   "put the presses and background.png into one folder, or use --surface"});
    return calibrateOnBalls(call);
}

}  // namespace

void addCalibrate(CLI::App& app, Action& action)
{
    auto* command = app.add_subcommand("calibrate", "calibrate a GelSight sensor from presses of a ball or from a known surface");
    auto call = std::make_shared<CalibrateCall>();
    command
        ->add_option("PRESSES", call->from,
                     "folder with background.png and one picture for each press; with --surface: the frames")
        ->required();
    auto* ball = command->add_option("--ball-radius", call->ballRadiusMm, "radius of the ball, mm")->check(aboveZero());
    auto* pitch = command->add_option("--mm-per-pixel", call->mmPerPixel, "pitch of the frames, mm")->check(aboveZero());
    command->add_option("--out", call->out, "calibration to write; its report and pictures go beside it")->required();
    command->add_option("--test", call->test, "folder of further presses to test the calibration on")->needs(ball);
    command->add_option("--quality", call->quality, "fast (linear), balanced (polynomial) or accurate (network)")
        ->check(CLI::IsMember({"fast", "balanced", "accurate"}));
    command
        ->add_option("--cutoff", call->cutoffMm,
                     "mm; removes longer waves from frames of full contact (default for balls: a quarter of the frame)")
        ->check(aboveZero());
    auto* surface = command
                        ->add_option("--surface", call->surface,
                                     "known height in mm (.tmd, .tiff or .npy) instead of balls; several frames show "
                                     "the same surface under one lamp each")
                        ->excludes(ball);
    command->add_option("--background", call->background, "with --surface: the untouched sensor")->needs(surface);
    command
        ->add_option("--rows", call->rows, "with --surface: use only these rows for the fit, as shares of the height, e.g. 0,0.5")
        ->delimiter(',')
        ->expected(2)
        ->check(finiteIn(0, 1))
        ->needs(surface);
    addJsonOption(*command, call->json);
    command->callback([call, ball, pitch, surface, &action] {
        if (surface->count() == 0 && (ball->count() == 0 || pitch->count() == 0))
            throw CLI::ValidationError("calibrate", "--ball-radius and --mm-per-pixel are required, or --surface");
        action.surroundings = Surroundings::Core;
        action.work = [call] { return calibrate(*call); };
    });
}

}  // namespace study::commands
