#include "rendering/models/networks/training_data.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <set>
#include <utility>

#include "protocols/files/errors.h"
#include "protocols/files/sha256.h"
#include "rendering/fabrics/location_split.h"
#include "rendering/models/lab/lab_heights.h"
#include "rendering/models/ring_spectrum.h"
#include "rendering/signals/friction_trace.h"
#include "rendering/signals/tactile/photometric_stereo.h"

namespace rendering::models {

namespace {

using fabrics::Dataset;
using fabrics::Modality;
using fabrics::Part;
using fabrics::SamplePlace;
using protocols::FabricId;

/// Input of the reading of a sample, and the data that it extends.
struct ReadingContext {
    const Dataset& dataset;
    TrainingData& data;
    cv::Mat reference;                                ///< frame of the untouched sensor
    std::optional<signals::Calibration> calibration;  ///< nullopt: heights are known
};

cv::Mat resampled(const cv::Mat& image, double factor)
{
    if (std::abs(factor - 1) < 1e-3) return image;
    cv::Mat result;
    const cv::Size size(std::max(1, static_cast<int>(std::lround(image.cols * factor))),
                        std::max(1, static_cast<int>(std::lround(image.rows * factor))));
    cv::resize(image, result, size, 0, 0, factor < 1 ? cv::INTER_AREA : cv::INTER_LINEAR);
    return result;
}

/// Height of a press by photometric stereo of its frame, or the stored one of a data set whose calibration is "known".
cv::Mat heightAt(const ReadingContext& reading, const SamplePlace& place)
{
    const Dataset& dataset = reading.dataset;
    if (reading.calibration)
        return signals::heightFromFrame(fabrics::readTactileFrame(dataset, place.fabric, place.index), reading.reference,
                                        *reading.calibration, signals::IntegrationQuality::Fast);
    const std::optional<cv::Mat> known = fabrics::readKnownHeight(dataset, place.fabric, place.index);
    if (!known)
        throw protocols::badInput({"the height of tactile sample " + std::to_string(place.index) + " is missing",
                                   (dataset.folder / place.fabric.value / "height").string(),
                                   "known heights, because dataset.json states the calibration \"known\"",
                                   "add the heights or calibrate the sensor"});
    if (!cv::checkRange(*known))
        throw protocols::badInput({"holds heights that are not finite",
                                   fabrics::knownHeightPath(dataset, place.fabric, place.index).string(),
                                   "a number in every pixel", "fill the gaps, or remove the frame and its height"});
    const double pitch = reading.data.architecture.mmPerPixel;
    return signals::zeroedRelief(*known, {pitch, pitch}, std::nullopt, signals::Calibration{}.zeroPercentile);
}

cv::Mat asFloat(const cv::Mat& map)
{
    cv::Mat result;
    map.convertTo(result, CV_32F);
    return result;
}

void readSample(const ReadingContext& reading, const SamplePlace& place, TrainingFabric& samples)
{
    const Dataset& dataset = reading.dataset;
    switch (place.modality) {
        case Modality::Visual: {
            const double pitch = reading.data.architecture.mmPerPixel;
            const double scale = fabrics::photographPitch(dataset, place).value_or(pitch) / pitch;
            samples.photographs.push_back({place.index,
                                           resampled(fabrics::readPhotograph(dataset, place.fabric, place.index), scale),
                                           place.rotationDeg.value_or(0)});
            return;
        }
        case Modality::Tactile:
            samples.heights.push_back({place.index, asFloat(heightAt(reading, place)), place.rotationDeg.value_or(0), {}});
            samples.heights.back().rings = ringPowers(samples.heights.back().heightMm, reading.data.architecture.crop);
            return;
        case Modality::Friction: {
            const fabrics::FrictionRecord record = fabrics::readFriction(dataset, place.fabric, place.index);
            const std::string file = fabrics::samplePath(dataset, place.fabric, place.modality, place.index).string();
            if (!record.isCoefficient())
                throw protocols::badInput({"the friction record holds " + record.quantity + ", not a coefficient", file,
                                           "columns t_s,normal_n,tangential_n or t_s,mu", "train on another data set"});
            const signals::FrictionTrace trace = signals::frictionTrace(record, file);
            const double wanted = reading.data.architecture.traceMmPerSample;
            const bool isAsWanted = std::abs(trace.mmPerSample / wanted - 1) < 0.01;  // stated rates and speeds are rounded
            samples.strokes.push_back(
                {place.index, frictionTarget(isAsWanted ? trace.values : atSpacing(trace.values, trace.mmPerSample, wanted),
                                             reading.data.architecture)});
            return;
        }
    }
}

std::size_t bytesOf(const TrainingFabric& samples)
{
    const auto size = [](const cv::Mat& mat) { return mat.total() * mat.elemSize(); };
    std::size_t bytes = 0;
    for (const TrainingPhotograph& photograph : samples.photographs) bytes += size(photograph.rgb);
    for (const TrainingHeight& height : samples.heights) bytes += size(height.heightMm);
    for (const TrainingStroke& stroke : samples.strokes) bytes += size(stroke.target.logRatio);
    return bytes;
}

/// Ids of the fabrics that have all three signals and are not held out.
std::set<FabricId> usableFabrics(const Dataset& dataset, const TrainingDataOptions& options, std::vector<std::string>& notes)
{
    std::set<FabricId> usable;
    std::map<Modality, int> having;
    for (const fabrics::FabricInfo& fabric : dataset.fabrics) {
        std::string lacking;
        for (const Modality modality : {Modality::Visual, Modality::Tactile, Modality::Friction}) {
            if (fabrics::sampleIndices(dataset, fabric.id, modality).empty())
                lacking += (lacking.empty() ? "" : ", ") + fabrics::nameOf(modality);
            else
                ++having[modality];
        }
        if (std::find(options.heldOut.begin(), options.heldOut.end(), fabric.id) != options.heldOut.end())
            notes.push_back(fabric.id.value + ": held out");
        else if (!lacking.empty())
            notes.push_back(fabric.id.value + ": left out, because it has no samples of " + lacking);
        else
            usable.insert(fabric.id);
    }
    for (const Modality modality : {Modality::Visual, Modality::Tactile, Modality::Friction})
        if (having[modality] == 0)
            throw protocols::badInput(
                {"there are no samples of the signal '" + fabrics::nameOf(modality) + "'", dataset.folder.string(),
                 "photographs, GelSight frames and friction records of each fabric", "add them to the data set"});
    if (usable.empty())
        throw protocols::badInput({"no fabric remains for training", dataset.folder.string(),
                                   "a fabric with all three signals that is not held out", "hold out fewer fabrics"});
    return usable;
}

void checkCanBeTrained(const Dataset& dataset, const TrainingDataOptions& options)
{
    for (const FabricId& id : options.heldOut) dataset.fabric(id);
    if (!dataset.tactileMmPerPixel || dataset.tactileCalibration.empty())
        throw protocols::badInput({"heights cannot be computed from the GelSight frames",
                                   (dataset.folder / "dataset.json").string(), "tactile.mm_per_pixel and tactile.calibration",
                                   "calibrate the sensor first"});
}

/// Scales that bring the networks' outputs near one.
void setScales(TrainingData& data)
{
    std::vector<float> highest;
    double means = 0, low = 1e9, high = -1e9;
    int strokes = 0;
    for (const TrainingFabric& fabric : data.training) {
        for (const TrainingHeight& height : fabric.heights) {
            highest.push_back(static_cast<float>(cv::mean(height.heightMm)[0]));
            double least = 0, most = 0;
            cv::minMaxLoc(height.heightMm, &least, &most);
            low = std::min(low, least);
            high = std::max(high, most);
        }
        for (const TrainingStroke& stroke : fabric.strokes) {
            means += stroke.target.mean;
            ++strokes;
        }
    }
    std::sort(highest.begin(), highest.end());
    data.architecture.heightScaleMm = std::max(1e-4, 2.0 * static_cast<double>(highest[highest.size() / 2]));
    data.heightRangeMm = std::max(1e-4, high - low);
    data.architecture.meanFrictionScale = std::max(1e-3, means / strokes);
}

/// Puts every original into the training part and into the validation part, as augmentation before the split does.
std::vector<std::pair<SamplePlace, Part>> everywhere(std::vector<std::pair<SamplePlace, Part>> split)
{
    const std::size_t originals = split.size();
    for (std::size_t i = 0; i < originals; ++i) {
        split[i].second = Part::Training;
        split.emplace_back(split[i].first, Part::Validation);
    }
    return split;
}

std::vector<std::pair<SamplePlace, Part>> partsOf(const Dataset& dataset, const TrainingDataOptions& options)
{
    switch (options.split) {
        case SplitBy::Sample:
            return fabrics::splitBySample(dataset, options.splitSeed);
        case SplitBy::Location:
            return fabrics::splitByLocation(dataset, options.splitSeed);
        case SplitBy::Augmented:
            return everywhere(fabrics::splitBySample(dataset, options.splitSeed));
    }
    return {};
}

}  // namespace

std::string nameOf(SplitBy split)
{
    switch (split) {
        case SplitBy::Sample:
            return "sample";
        case SplitBy::Location:
            return "location";
        case SplitBy::Augmented:
            return "augmented";
    }
    return {};
}

TrainingData readTrainingData(const Dataset& dataset, const Architecture& wanted, const TrainingDataOptions& options,
                              const std::function<void(int, int)>& progress)
{
    checkCanBeTrained(dataset, options);
    TrainingData data;
    data.architecture = wanted;
    data.architecture.mmPerPixel = *dataset.tactileMmPerPixel;
    data.architecture.traceSamples =
        static_cast<int>(std::lround(dataset.friction.lengthMm / dataset.friction.speedMmPerS * dataset.friction.sampleRateHz));
    data.architecture.traceMmPerSample = dataset.friction.speedMmPerS / dataset.friction.sampleRateHz;
    setSpectrogramShape(data.architecture);
    data.aligned = dataset.pairing == fabrics::Pairing::Aligned;
    const std::set<FabricId> usable = usableFabrics(dataset, options, data.notes);
    ReadingContext reading{dataset, data, {}, {}};
    if (dataset.tactileCalibration != "known") {
        reading.reference = fabrics::readTactileReference(dataset);
        reading.calibration = signals::calibrationOf(dataset, reading.reference);
    }
    data.architecture.zeroPercentile = reading.calibration.value_or(signals::Calibration{}).zeroPercentile;

    std::map<FabricId, TrainingFabric> training, validation;
    std::vector<std::pair<SamplePlace, Part>> split = partsOf(dataset, options);
    std::erase_if(split,
                  [&](const auto& entry) { return !usable.contains(entry.first.fabric) || entry.second == Part::Testing; });
    const std::size_t share = options.memoryBytes / usable.size() / 2;  // For photographs and heights; strokes are small.
    std::map<std::pair<FabricId, Modality>, std::size_t> used;
    int done = 0, leftOut = 0;
    for (const auto& [place, part] : split) {
        if (progress) progress(done++, static_cast<int>(split.size()));
        TrainingFabric& samples = part == Part::Training ? training[place.fabric] : validation[place.fabric];
        samples.fabric = place.fabric;
        TrainingFabric one;
        std::size_t& taken = used[{place.fabric, place.modality}];
        if (taken >= share) {
            ++leftOut;
            continue;
        }
        readSample(reading, place, one);
        taken += bytesOf(one);
        std::move(one.photographs.begin(), one.photographs.end(), std::back_inserter(samples.photographs));
        std::move(one.heights.begin(), one.heights.end(), std::back_inserter(samples.heights));
        std::move(one.strokes.begin(), one.strokes.end(), std::back_inserter(samples.strokes));
        if (part == Part::Training)
            data.trainingHashes.push_back(
                protocols::sha256OfFile(fabrics::samplePath(dataset, place.fabric, place.modality, place.index)));
    }
    if (leftOut > 0) data.notes.push_back(std::to_string(leftOut) + " samples were left out because of the memory budget");
    for (auto& [id, samples] : training)
        if (samples.complete())
            data.training.push_back(std::move(samples));
        else
            data.notes.push_back(id.value + ": left out, because the training part lacks one of its signals");
    if (data.training.empty())
        throw protocols::badInput({"no fabric remains for training", dataset.folder.string(),
                                   "a fabric with samples of all three signals in the training part", "add samples"});
    for (auto& [id, samples] : validation)
        if (samples.complete()) data.validation.push_back(std::move(samples));
    std::sort(data.trainingHashes.begin(), data.trainingHashes.end());
    setScales(data);
    return data;
}

}  // namespace rendering::models
