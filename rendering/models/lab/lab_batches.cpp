#include "rendering/models/lab/lab_batches.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "protocols/random.h"
#include "rendering/models/lab/lab_heights.h"
#include "rendering/models/seeing/pitch_unit.h"
#include "rendering/models/seeing/slow_relief.h"
#include "rendering/models/seeing/told_lamp.h"

namespace rendering::models {

namespace {

using protocols::Random;

constexpr float noMeasurement = std::numeric_limits<float>::quiet_NaN();
/// A camera keeps its sharpness and its distance, so most patches keep their size, too.
constexpr double unzoomedLabShare = 0.6, mostLabZoom = 1.35;
constexpr int pressWindows = 4, smallestPressSide = 48;
constexpr double leastMeasured = 0.3;  ///< share of a window; with less, no relief is learned from it
constexpr int triesForMeasured = 6;
/// A press resolves waves down to 2.5 of its pixels.
constexpr double resolvedByPress = 0.4;

/// Training photographs of each fabric that has any.
std::vector<std::vector<std::size_t>> byFabric(const LabCloth& lab)
{
    std::map<std::size_t, std::vector<std::size_t>> sorted;
    for (const std::size_t i : lab.photographsOf(LabPart::Training)) sorted[lab.photographs[i].fabric].push_back(i);
    std::vector<std::vector<std::size_t>> all;
    for (auto& [fabric, photographs] : sorted) all.push_back(std::move(photographs));
    return all;
}

/// A square of a photograph at the size of a patch.
struct LabPatch {
    cv::Mat rgb, reliefMm;  ///< relief empty where none is registered
    double mmPerPixel = 0.05;
};

/// The photograph with mirrored borders, where it is smaller than a patch. Borders have no relief.
void enlarge(cv::Mat& rgb, cv::Mat& relief, int side)
{
    const int across = std::max(0, side - rgb.cols), down = std::max(0, side - rgb.rows);
    if (across == 0 && down == 0) return;
    cv::copyMakeBorder(rgb, rgb, 0, down, 0, across, cv::BORDER_REFLECT_101);
    if (!relief.empty()) cv::copyMakeBorder(relief, relief, 0, down, 0, across, cv::BORDER_CONSTANT, cv::Scalar(noMeasurement));
}

LabPatch cutPatch(const LabPhotograph& photograph, int side, Random& random)
{
    cv::Mat rgb = photograph.rgb, relief = photograph.reliefMm;
    const double zoom = std::log(mostLabZoom);
    const double shrink = random.uniform() < unzoomedLabShare ? 1 : std::exp(random.uniform(-zoom, zoom));
    const int wanted = static_cast<int>(std::lround(side * shrink));
    enlarge(rgb, relief, std::min(wanted, side));
    const int taken = std::min({wanted, rgb.cols, rgb.rows});
    LabPatch patch;
    for (int attempt = 0; attempt < triesForMeasured; ++attempt) {
        const auto start = [&](int length) {
            return static_cast<int>(random.below(static_cast<std::uint64_t>(length - taken) + 1));
        };
        const int x = start(rgb.cols), y = start(rgb.rows);
        const cv::Rect part(x, y, taken, taken);
        patch.rgb = rgb(part).clone();
        if (relief.empty()) break;
        patch.reliefMm = relief(part).clone();
        if (measuredShare(patch.reliefMm) >= leastMeasured) break;
    }
    if (taken != side) {
        cv::resize(patch.rgb, patch.rgb, {side, side}, 0, 0, taken > side ? cv::INTER_AREA : cv::INTER_CUBIC);
        if (!patch.reliefMm.empty()) patch.reliefMm = scaledHeights(patch.reliefMm, static_cast<double>(side) / taken);
    }
    patch.mmPerPixel = photograph.mmPerPixel * taken / side;
    return patch;
}

/// Presses of the training part, cut at random places and brought to the pitch of the patch.
PressWindows windowsOf(const LabFabric& fabric, const LabCloth& lab, const LabPatch& patch, const LabBatchOptions& options,
                       Random& random)
{
    std::vector<const cv::Mat*> maps;
    for (const LabPress& press : fabric.presses)
        if (press.part == LabPart::Training) maps.push_back(&press.heightMm);
    PressWindows windows;
    if (maps.empty()) return windows;
    const double factor = lab.pressMmPerPixel / patch.mmPerPixel;
    const int shortest = static_cast<int>(std::floor(std::min(maps.front()->cols, maps.front()->rows) * factor));
    const int side = std::min(options.side, shortest) / 16 * 16;
    if (side < smallestPressSide) return windows;
    windows.highestFrequency = std::min(0.5, resolvedByPress / std::max(1.0, factor));
    double measured = 0;
    for (int attempt = 0; attempt < 2 * pressWindows && windows.count < pressWindows; ++attempt) {
        const cv::Mat& map = *maps[random.below(maps.size())];
        const int taken = std::min({static_cast<int>(std::lround(side / factor)), map.cols, map.rows});
        const auto start = [&](int length) {
            return static_cast<int>(random.below(static_cast<std::uint64_t>(length - taken) + 1));
        };
        const int x = start(map.cols), y = start(map.rows);
        cv::Mat window = scaledHeights(map({x, y, taken, taken}), static_cast<double>(side) / taken);
        const double share = measuredShare(window);
        if (share < leastMeasured) continue;
        window = withoutSlowHeights(window, slowSigmaPx) / (patch.mmPerPixel * options.reliefFactor);
        cv::patchNaNs(window, 0);
        windows.reliefs.insert(windows.reliefs.end(), window.begin<float>(), window.end<float>());
        measured += share;
        ++windows.count;
    }
    if (windows.count == 0) return {};
    windows.side = side;
    windows.measured = measured / windows.count;
    return windows;
}

void appendStroke(ClothBatch& batch, const LabFabric& fabric, const Architecture& architecture, Random& random)
{
    std::vector<const LabStroke*> strokes;
    for (const LabStroke& stroke : fabric.strokes)
        if (stroke.part == LabPart::Training) strokes.push_back(&stroke);
    const std::size_t cells = std::size_t(architecture.rows) * std::size_t(architecture.frames);
    if (strokes.empty()) {
        batch.logRatios.insert(batch.logRatios.end(), cells, noMeasurement);
        return;
    }
    const cv::Mat& ratio = strokes[random.below(strokes.size())]->target.logRatio;
    batch.logRatios.insert(batch.logRatios.end(), ratio.begin<float>(), ratio.end<float>());
}

}  // namespace

LabBatch drawLabBatch(const LabCloth& lab, const Architecture& architecture, const LabBatchOptions& options, std::uint64_t seed,
                      std::uint64_t number)
{
    Random random = Random::stream(seed, "lab batch/" + std::to_string(number));
    const std::vector<std::vector<std::size_t>> fabrics = byFabric(lab);
    LabBatch batch;
    ClothBatch& cloth = batch.cloth;
    cloth.size = options.size;
    cloth.side = options.side;
    const auto size = static_cast<std::size_t>(options.size);
    const auto pixels = static_cast<std::size_t>(options.side) * static_cast<std::size_t>(options.side);
    cloth.photographs.resize(3 * pixels * size);
    cloth.reliefs.resize(pixels * size);
    for (std::size_t i = 0; i < size; ++i) {
        const std::vector<std::size_t>& own = fabrics[random.below(fabrics.size())];
        const LabPhotograph& photograph = lab.photographs[own[random.below(own.size())]];
        const LabFabric& fabric = lab.fabrics[photograph.fabric];
        const LabPatch patch = cutPatch(photograph, options.side, random);
        const ToldLamp lamp = random.uniform() < options.toldShare ? toldLamp(photograph.lightDeg) : ToldLamp{};
        cloth.lamps.insert(cloth.lamps.end(), lamp.numbers.begin(), lamp.numbers.end());
        copyPhotograph(turned(patch.rgb, lamp.turn), cloth.photographs.data() + 3 * pixels * i);
        cv::Mat relief(options.side, options.side, CV_32F, cloth.reliefs.data() + pixels * i);
        const bool registered = measuredShare(patch.reliefMm) >= leastMeasured;
        if (registered)
            cv::Mat(turned(patch.reliefMm, lamp.turn) / (patch.mmPerPixel * options.reliefFactor)).copyTo(relief);
        else
            relief.setTo(noMeasurement);
        batch.amplitudesKnown.push_back(photograph.amplitudeKnown ? 1 : 0);
        batch.presses.push_back(registered ? PressWindows{} : windowsOf(fabric, lab, patch, options, random));
        cloth.logPitches.push_back(static_cast<float>(std::log(patch.mmPerPixel / pitchUnitMm)));
        cloth.logFrictions.push_back(static_cast<float>(logMeanToRead(
            fabric.logFriction(LabPart::Training) - options.logFrictionFactor, architecture.fibres, photograph.fibre)));
        appendStroke(cloth, fabric, architecture, random);
    }
    return batch;
}

}  // namespace rendering::models
