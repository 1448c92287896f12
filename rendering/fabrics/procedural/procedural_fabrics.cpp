#include "rendering/fabrics/procedural/procedural_fabrics.h"

#include <cmath>

#include "protocols/files/errors.h"
#include "protocols/files/folder_draft.h"
#include "protocols/random.h"
#include "rendering/fabrics/procedural/photograph.h"
#include "rendering/fabrics/procedural/stroke_rig.h"
#include "rendering/fabrics/procedural/structures.h"
#include "rendering/fabrics/procedural/surface.h"
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

constexpr double fieldMm = 1000;  // Places are drawn from a square with this side.
/// The five in-plane rotations in which a piece of fabric is photographed.
constexpr double photographRotationsDeg[] = {0, 30, 60, 90, 135};

/// A fabric that is ready to be sampled.
struct Cloth {
    FabricInfo info;
    FabricSurface surface;
    double friction;
};

std::string twoDigits(int number) { return (number < 10 ? "0" : "") + std::to_string(number); }

std::vector<Cloth> layOut(const Dataset& dataset, std::uint64_t seed)
{
    std::vector<Cloth> cloths;
    for (std::size_t i = 0; i < dataset.fabrics.size(); ++i) {
        const FabricInfo& info = dataset.fabrics[i];
        FabricSurface surface(allStructures()[i], Random::stream(seed, info.id.value + "/surface").next());
        const double friction = meanFriction(surface, dataset.friction);
        cloths.push_back({info, std::move(surface), friction});
    }
    return cloths;
}

Dataset describe(const fs::path& folder, const ProceduralOptions& options)
{
    Dataset dataset;
    dataset.folder = folder;
    dataset.name = "procedural fabrics, seed " + std::to_string(options.seed);
    for (int i = 0; i < options.fabrics; ++i) {
        const Structure& structure = allStructures()[std::size_t(i)];
        dataset.fabrics.push_back(
            {protocols::FabricId("F" + twoDigits(i + 1)), std::string(structure.name), std::string(structure.structure)});
    }
    dataset.cameraMmPerPixel = photographMmPerPixel;
    dataset.tactileMmPerPixel = tactileMmPerPixel;
    dataset.tactileCalibration = "tactile-calibration.json";
    dataset.pairing = options.pairing;
    dataset.procedural = true;
    dataset.licence = "CC0-1.0";
    return dataset;
}

/// Place of a sample. In an aligned data set all three signals of an index lie at the place of its photograph.
FabricPlace placeOf(const Cloth& cloth, Modality modality, int index, const ProceduralOptions& options)
{
    const bool aligned = options.pairing == Pairing::Aligned;
    const std::string signal = aligned ? "place" : nameOf(modality) + "/place";
    Random random = Random::stream(options.seed, cloth.info.id.value + "/" + signal + "/" + std::to_string(index));
    FabricPlace place{random.uniform(0, fieldMm), random.uniform(0, fieldMm), random.uniform(-3, 3)};
    if (aligned || modality == Modality::Visual) place.rotationDeg += photographRotationsDeg[index % 5];
    // Rounded as in samples.csv, so that a reader of that file finds exactly this place.
    const auto rounded = [](double value) { return std::round(value * 1000) / 1000; };
    return {rounded(place.xMm), rounded(place.yMm), rounded(place.rotationDeg)};
}

void makeSample(const Dataset& dataset, const Cloth& cloth, Modality modality, int index, const ProceduralOptions& options)
{
    const FabricPlace place = placeOf(cloth, modality, index, options);
    Random random = Random::stream(options.seed, cloth.info.id.value + "/" + nameOf(modality) + "/" + std::to_string(index));
    const fs::path file = samplePath(dataset, cloth.info.id, modality, index);
    switch (modality) {
        case Modality::Visual:
            writePng(file, photograph(cloth.surface, place, random), Sync::Later);
            return;
        case Modality::Tactile: {
            const Press press = pressSensor(cloth.surface, place, random);
            writePng(file, press.frame, Sync::Later);
            writeTiff(knownHeightPath(dataset, cloth.info.id, index), press.heightMm, Sync::Later);
            return;
        }
        case Modality::Friction:
            protocols::writeWholeFile(file, toCsv(strokeFabric(cloth.surface, cloth.friction, place, dataset.friction, random)),
                                      Sync::Later);
            return;
    }
}

/// Makes every sample of every fabric. Each sample has its own stream of random numbers, so the order of the work does not
/// change the result.
void makeAllSamples(const Dataset& dataset, const std::vector<Cloth>& cloths, const ProceduralOptions& options,
                    const std::function<void(int, int)>& progress)
{
    const int perFabric = options.samples * 3;
    const int total = perFabric * int(cloths.size());
    stats::onThreads(
        static_cast<std::size_t>(total), options.threads,
        [&](std::size_t number) {
            const int job = static_cast<int>(number);
            makeSample(dataset, cloths[std::size_t(job / perFabric)], allModalities[job % 3], job % perFabric / 3, options);
        },
        [&](std::size_t done) {
            if (progress) progress(static_cast<int>(done), total);
        });
}

std::vector<SamplePlace> placesOf(const std::vector<Cloth>& cloths, const ProceduralOptions& options)
{
    std::vector<SamplePlace> places;
    for (const Cloth& cloth : cloths)
        for (const Modality modality : allModalities)
            for (int index = 0; index < options.samples; ++index) {
                const FabricPlace place = placeOf(cloth, modality, index, options);
                const std::string group = cloth.info.id.value + "/" +
                                          (options.pairing == Pairing::Aligned ? "place" : nameOf(modality)) + "/" +
                                          std::to_string(index);
                places.push_back({cloth.info.id, modality, index, place.xMm, place.yMm, place.rotationDeg, group});
            }
    return places;
}

void refuseImpossible(const fs::path& folder, const ProceduralOptions& options)
{
    const int most = int(allStructures().size());
    if (options.fabrics < 1 || options.fabrics > most)
        throw protocols::badInput({"cannot make " + std::to_string(options.fabrics) + " fabrics", "--fabrics",
                                   "1 to " + std::to_string(most), "choose another number"});
    if (options.samples < 1 || options.samples > 100000)
        throw protocols::badInput(
            {"cannot make " + std::to_string(options.samples) + " samples", "--samples", "1 to 100000", "choose another number"});
    std::error_code problem;
    if (fs::exists(folder, problem) && !(fs::is_directory(folder, problem) && fs::is_empty(folder, problem)))
        throw protocols::badInput({"exists and is not empty", folder.string(), "a new or empty folder", "choose another folder"});
}

}  // namespace

Dataset makeProceduralFabrics(const fs::path& folder, const ProceduralOptions& options,
                              const std::function<void(int, int)>& progress)
{
    refuseImpossible(folder, options);
    protocols::FolderDraft draft(folder, protocols::Earlier::Refused);
    Dataset dataset = describe(draft.path(), options);
    for (const FabricInfo& fabric : dataset.fabrics)
        for (const char* signal : {"visual", "tactile", "friction", "height"})
            protocols::makeFolders(draft.path() / fabric.id.value / signal, Sync::Later);
    const std::vector<Cloth> cloths = layOut(dataset, options.seed);
    makeAllSamples(dataset, cloths, options, progress);
    writePng(draft.file("tactile-reference.png"), tactileReference(), Sync::Later);
    protocols::writeWholeFile(draft.file("tactile-calibration.json"), tactileCalibrationJson(), Sync::Later);
    writeSamplePlaces(dataset, placesOf(cloths, options));
    writeDatasetJson(dataset);
    draft.putInPlace();
    dataset.folder = folder;
    return dataset;
}

}  // namespace rendering::fabrics
