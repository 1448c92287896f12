#include "rendering/fabrics/procedural/procedural_fabrics.h"

#include <atomic>
#include <cmath>
#include <exception>
#include <mutex>
#include <thread>

#include "protocols/files/errors.h"
#include "protocols/files/whole_file.h"
#include "protocols/random.h"
#include "rendering/fabrics/procedural/photograph.h"
#include "rendering/fabrics/procedural/stroke_rig.h"
#include "rendering/fabrics/procedural/structures.h"
#include "rendering/fabrics/procedural/surface.h"
#include "rendering/fabrics/procedural/tactile_press.h"
#include "rendering/fabrics/sample_places.h"
#include "rendering/images/image_io.h"

namespace rendering::fabrics {

namespace {

namespace fs = std::filesystem;
using protocols::Random;

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
            writePng(file, photograph(cloth.surface, place, random));
            return;
        case Modality::Tactile: {
            const Press press = pressSensor(cloth.surface, place, random);
            writePng(file, press.frame);
            writeTiff(knownHeightPath(dataset, cloth.info.id, index), press.heightMm);
            return;
        }
        case Modality::Friction:
            writeWholeFile(file, toCsv(strokeFabric(cloth.surface, cloth.friction, place, dataset.friction, random)));
            return;
    }
}

constexpr Modality modalities[] = {Modality::Visual, Modality::Tactile, Modality::Friction};

/// Makes every sample of every fabric; an atomic counter gives the threads their work. Each sample has its own
/// stream of random numbers, so the order of the work does not change the result.
void makeAllSamples(const Dataset& dataset, const std::vector<Cloth>& cloths, const ProceduralOptions& options,
                    const std::function<void(int, int)>& progress)
{
    const int perFabric = options.samples * 3;
    const int total = perFabric * int(cloths.size());
    std::atomic<int> next{0};
    std::mutex reporting;
    int done = 0;
    std::exception_ptr failure;
    const auto work = [&] {
        for (int job = next++; job < total; job = next++) {
            try {
                makeSample(dataset, cloths[std::size_t(job / perFabric)], modalities[job % 3], job % perFabric / 3, options);
            } catch (...) {
                const std::lock_guard lock(reporting);
                failure = std::current_exception();
                next = total;
                return;
            }
            const std::lock_guard lock(reporting);
            ++done;
            if (progress) progress(done, total);
        }
    };
    std::vector<std::thread> threads;
    for (int i = 1; i < options.threads; ++i) threads.emplace_back(work);
    work();
    for (std::thread& thread : threads) thread.join();
    if (failure) std::rethrow_exception(failure);
}

std::vector<SamplePlace> placesOf(const std::vector<Cloth>& cloths, const ProceduralOptions& options)
{
    std::vector<SamplePlace> places;
    for (const Cloth& cloth : cloths)
        for (const Modality modality : modalities)
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

/// Runs `step` and turns a refusal of the file system into an environmentFault.
template <class Step>
void onDisk(const fs::path& folder, Step step)
{
    try {
        step();
    } catch (const fs::filesystem_error& error) {
        throw protocols::environmentFault({"cannot be written (" + error.code().message() + ")", folder.string(),
                                           "a writable folder with free space", "free space or choose another folder"});
    }
}

}  // namespace

Dataset makeProceduralFabrics(const fs::path& folder, const ProceduralOptions& options,
                              const std::function<void(int, int)>& progress)
{
    refuseImpossible(folder, options);
    fs::path target = fs::absolute(folder).lexically_normal();
    if (!target.has_filename()) target = target.parent_path();
    fs::path unfinished = target;
    unfinished.replace_filename("." + target.filename().string() + ".unfinished");
    Dataset dataset = describe(unfinished, options);
    try {
        onDisk(folder, [&] {
            fs::remove_all(unfinished);
            for (const FabricInfo& fabric : dataset.fabrics)
                for (const char* signal : {"visual", "tactile", "friction", "height"})
                    fs::create_directories(unfinished / fabric.id.value / signal);
        });
        const std::vector<Cloth> cloths = layOut(dataset, options.seed);
        makeAllSamples(dataset, cloths, options, progress);
        writePng(unfinished / "tactile-reference.png", tactileReference());
        writeWholeFile(unfinished / "tactile-calibration.json", tactileCalibrationJson());
        writeSamplePlaces(dataset, placesOf(cloths, options));
        writeDatasetJson(dataset);
        onDisk(folder, [&] {
            fs::remove(target);  // Exists at most as an empty folder.
            fs::rename(unfinished, target);
        });
    } catch (...) {
        std::error_code ignored;
        fs::remove_all(unfinished, ignored);
        throw;
    }
    dataset.folder = folder;
    return dataset;
}

}  // namespace rendering::fabrics
