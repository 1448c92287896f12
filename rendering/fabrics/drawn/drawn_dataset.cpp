#include "rendering/fabrics/drawn/drawn_dataset.h"

#include <charconv>
#include <cmath>
#include <string_view>

#include "protocols/files/errors.h"
#include "protocols/files/folder_draft.h"
#include "rendering/fabrics/drawn/drawn_friction.h"
#include "rendering/fabrics/drawn/drawn_patch.h"
#include "rendering/fabrics/procedural/tactile_press.h"
#include "rendering/fabrics/sample_places.h"
#include "rendering/images/image_png.h"
#include "rendering/images/image_tiff.h"
#include "stats/kernels/threads.h"

namespace rendering::fabrics {

namespace {

namespace fs = std::filesystem;
using protocols::Random;
using protocols::Sync;

constexpr std::string_view drawnSetName = "drawn fabrics, seed ";  // The seed follows.
constexpr double drawnAreaMm = 1000;                               // Places are drawn from a square with this side.
constexpr int mostDrawnFabrics = 10000;

/// A construction that is ready to be sampled.
struct DrawnCloth {
    FabricInfo info;
    DrawnFabric fabric;
    double friction = 0;
};

std::string paddedId(int number) { return "F" + std::string(number < 10 ? "0" : "") + std::to_string(number); }

Random streamOf(const DrawnOptions& options, const DrawnCloth& cloth, const std::string& purpose, int index)
{
    return Random::stream(options.seed, "drawn set/" + cloth.info.id.value + "/" + purpose + "/" + std::to_string(index));
}

std::vector<DrawnCloth> layOutDrawn(Dataset& dataset, const DrawnOptions& options)
{
    std::vector<DrawnCloth> cloths(static_cast<std::size_t>(options.fabrics));
    stats::onThreads(cloths.size(), options.threads, [&](std::size_t i) {
        DrawnCloth& cloth = cloths[i];
        cloth.fabric = drawFabric(options.seed, i);
        const std::string words = inWords(cloth.fabric);
        cloth.info = {protocols::FabricId(paddedId(static_cast<int>(i) + 1)), words.substr(0, words.find(',')), words};
        cloth.info.fibre = cloth.fabric.fibre;
        cloth.friction = meanFriction(cloth.fabric);
    });
    for (const DrawnCloth& cloth : cloths) dataset.fabrics.push_back(cloth.info);
    return cloths;
}

Dataset describeDrawn(const fs::path& folder, const DrawnOptions& options)
{
    Dataset dataset;
    dataset.folder = folder;
    dataset.name = std::string(drawnSetName) + std::to_string(options.seed);
    dataset.tactileMmPerPixel = tactileMmPerPixel;
    dataset.tactileCalibration = "tactile-calibration.json";
    dataset.pairing = options.pairing;
    dataset.procedural = true;
    dataset.surfaceIsFree = true;
    dataset.licence = "CC0-1.0";
    return dataset;
}

/// Rounded as in samples.csv, so that a reader of that file finds exactly this place.
double roundedTo(double value, double stepsPerUnit) { return std::round(value * stepsPerUnit) / stepsPerUnit; }

/// Where a sample lies. In an aligned data set all three signals of an index lie at the place of its photograph.
FabricPlace drawnPlace(const DrawnCloth& cloth, Modality modality, int index, const DrawnOptions& options)
{
    const bool aligned = options.pairing == Pairing::Aligned;
    Random random = streamOf(options, cloth, aligned ? "place" : nameOf(modality) + "/place", index);
    return {roundedTo(random.uniform(0, drawnAreaMm), 1e3), roundedTo(random.uniform(0, drawnAreaMm), 1e3),
            roundedTo(random.uniform(0, 360), 1e3)};
}

/// Camera and scale of one photograph.
struct DrawnView {
    double mmPerPixel;
    ClothCamera camera;
};
DrawnView drawnView(const DrawnCloth& cloth, int index, const DrawnOptions& options)
{
    Random random = streamOf(options, cloth, "camera", index);
    const double pitch = roundedTo(drawPitch(cloth.fabric, random), 1e6);
    return {pitch, drawCamera(false, random)};
}

void makeDrawnSample(const Dataset& dataset, const DrawnCloth& cloth, Modality modality, int index, const DrawnOptions& options)
{
    const FabricPlace place = drawnPlace(cloth, modality, index, options);
    Random random = streamOf(options, cloth, nameOf(modality), index);
    const fs::path file = samplePath(dataset, cloth.info.id, modality, index);
    switch (modality) {
        case Modality::Visual: {
            const DrawnView view = drawnView(cloth, index, options);
            const ClothPhotograph photograph = photographCloth(cloth.fabric, place, {drawnPhotographPx, drawnPhotographPx},
                                                               view.mmPerPixel, view.camera, random);
            writePng(file, photograph.rgb, Sync::Later);
            writeTiff(surfacePath(dataset, cloth.info.id, index), photograph.heightMm, Sync::Later);
            return;
        }
        case Modality::Tactile: {
            const cv::Size size(tactileWidthPx, tactileHeightPx);
            const Press press =
                pressSurface(clothWindow(cloth.fabric, place, size, tactileMmPerPixel, SlackShown::No).heightMm, random);
            writePng(file, press.frame, Sync::Later);
            writeTiff(knownHeightPath(dataset, cloth.info.id, index), press.heightMm, Sync::Later);
            return;
        }
        case Modality::Friction:
            protocols::writeWholeFile(file, toCsv(strokeDrawn(cloth.fabric, cloth.friction, place, dataset.friction, random)),
                                      Sync::Later);
            return;
    }
}

SamplePlace placeRow(const DrawnCloth& cloth, Modality modality, int index, const DrawnOptions& options)
{
    const FabricPlace place = drawnPlace(cloth, modality, index, options);
    SamplePlace row{cloth.info.id, modality, index, place.xMm, place.yMm, place.rotationDeg, {}};
    row.group = options.pairing == Pairing::Aligned ? cloth.info.id.value + "/place/" + std::to_string(index)
                                                    : ownGroup(cloth.info.id, modality, index);
    if (modality != Modality::Visual) return row;
    const DrawnView view = drawnView(cloth, index, options);
    static constexpr const char* lights[] = {"one_lamp", "two_lamps", "three_lamps", "four_lamps"};
    row.mmPerPixel = view.mmPerPixel;
    row.light = lights[view.camera.lamps.size() - 1];
    if (const auto side = lightSide(view.camera)) row.lightDeg = roundedTo(*side, 10);
    return row;
}

void makeDrawnSamples(const Dataset& dataset, const std::vector<DrawnCloth>& cloths, const DrawnOptions& options,
                      const std::function<void(int, int)>& progress)
{
    const int perFabric = options.samples * 3, total = perFabric * int(cloths.size());
    stats::onThreads(
        static_cast<std::size_t>(total), options.threads,
        [&](std::size_t number) {
            const int job = static_cast<int>(number);
            makeDrawnSample(dataset, cloths[std::size_t(job / perFabric)], allModalities[job % 3], job % perFabric / 3, options);
        },
        [&](std::size_t done) {
            if (progress) progress(static_cast<int>(done), total);
        });
}

void refuseImpossibleDrawn(const fs::path& folder, const DrawnOptions& options)
{
    if (options.fabrics < 1 || options.fabrics > mostDrawnFabrics)
        throw protocols::badInput({"cannot draw " + std::to_string(options.fabrics) + " fabrics", "--drawn",
                                   "1 to " + std::to_string(mostDrawnFabrics), "choose another number"});
    if (options.samples < 1 || options.samples > 100000 || options.samples > 60000000 / options.fabrics)
        throw protocols::badInput({"cannot make " + std::to_string(options.samples) + " samples of each signal", "--samples",
                                   "1 to 100000, and at most 60 million in all", "choose another number"});
    std::error_code problem;
    if (fs::exists(folder, problem) && !(fs::is_directory(folder, problem) && fs::is_empty(folder, problem)))
        throw protocols::badInput({"exists and is not empty", folder.string(), "a new or empty folder", "choose another folder"});
}

}  // namespace

Dataset makeDrawnFabrics(const fs::path& folder, const DrawnOptions& options, const std::function<void(int, int)>& progress)
{
    refuseImpossibleDrawn(folder, options);
    protocols::FolderDraft draft(folder, protocols::Earlier::Refused);
    Dataset dataset = describeDrawn(draft.path(), options);
    const std::vector<DrawnCloth> cloths = layOutDrawn(dataset, options);
    for (const FabricInfo& fabric : dataset.fabrics)
        for (const char* signal : {"visual", "surface", "tactile", "height", "friction"})
            protocols::makeFolders(draft.path() / fabric.id.value / signal, Sync::Later);
    makeDrawnSamples(dataset, cloths, options, progress);
    writePng(draft.file("tactile-reference.png"), tactileReference(), Sync::Later);
    protocols::writeWholeFile(draft.file("tactile-calibration.json"), tactileCalibrationJson(), Sync::Later);
    std::vector<SamplePlace> places;
    for (const DrawnCloth& cloth : cloths)
        for (const Modality modality : allModalities)
            for (int index = 0; index < options.samples; ++index) places.push_back(placeRow(cloth, modality, index, options));
    writeSamplePlaces(dataset, places);
    writeDatasetJson(dataset);
    draft.putInPlace();
    dataset.folder = folder;
    return dataset;
}

std::optional<std::uint64_t> drawnSeedOf(const Dataset& dataset)
{
    if (!dataset.name.starts_with(drawnSetName)) return std::nullopt;
    const std::string_view digits = std::string_view(dataset.name).substr(drawnSetName.size());
    std::uint64_t seed = 0;
    const auto [end, fault] = std::from_chars(digits.data(), digits.data() + digits.size(), seed);
    if (fault != std::errc() || end != digits.data() + digits.size()) return std::nullopt;
    return seed;
}

}  // namespace rendering::fabrics
