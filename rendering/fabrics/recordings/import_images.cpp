#include "rendering/fabrics/recordings/import_images.h"

#include <algorithm>
#include <map>
#include <opencv2/imgproc.hpp>

#include "protocols/files/errors.h"
#include "protocols/files/number_text.h"
#include "protocols/files/whole_file.h"
#include "rendering/fabrics/recordings/import_sources.h"
#include "rendering/fabrics/recordings/photograph_files.h"
#include "rendering/images/image_png.h"

namespace rendering::fabrics {

namespace fs = std::filesystem;
using protocols::Sync;

namespace {

std::string sizeOf(const cv::Mat& image) { return std::to_string(image.cols) + " x " + std::to_string(image.rows) + " px"; }

std::string headOf(const Dataset& dataset, const protocols::FabricId& id)
{
    const FabricInfo& info = dataset.fabric(id);
    return id.value + (info.name == id.value ? "" : " " + info.name);
}

/// Imported samples of a fabric, for a line such as "3 photographs (samples 0 to 2), 512 x 512 px".
struct SampleCount {
    int samples = 0, first = 0, last = 0;
    std::string size;
};
using ImportCounts = std::map<protocols::FabricId, SampleCount>;

void countSample(ImportCounts& counts, const protocols::FabricId& fabric, int index, const cv::Mat& image)
{
    SampleCount& count = counts[fabric];
    if (count.samples++ == 0) {
        count.first = index;
        count.size = sizeOf(image);
    } else if (count.size != sizeOf(image)) {
        count.size = "different sizes";
    }
    count.last = index;
}

std::vector<std::string> linesFor(const ImportCounts& counts, const Dataset& dataset, const std::string& what,
                                  const std::string& remark)
{
    std::vector<std::string> lines;
    for (const auto& [fabric, count] : counts)
        lines.push_back(headOf(dataset, fabric) + ": " + std::to_string(count.samples) + " " + what +
                        (count.samples == 1 ? "" : "s") + " (samples " + std::to_string(count.first) + " to " +
                        std::to_string(count.last) + "), " + count.size + ", " + remark);
    return lines;
}

bool isReference(const fs::path& file)
{
    const std::string stem = lowerCase(file.stem().string());
    return stem.starts_with("background") || stem.starts_with("reference");
}

bool samePixels(const cv::Mat& a, const cv::Mat& b)
{
    return a.size() == b.size() && a.type() == b.type() && cv::norm(a, b, cv::NORM_INF) == 0;
}

bool hasSamples(const Dataset& dataset, Modality modality)
{
    return std::any_of(dataset.fabrics.begin(), dataset.fabrics.end(),
                       [&](const FabricInfo& fabric) { return !sampleIndices(dataset, fabric.id, modality).empty(); });
}

/// Reference frame among the files or in the data set; empty if there is none. Throws badInput where two differ.
cv::Mat referenceAmong(const std::vector<SourceFile>& files, const ImportRequest& request, const Dataset& dataset,
                       bool datasetIsNew)
{
    cv::Mat reference;
    fs::path from;
    if (!datasetIsNew && fs::exists(dataset.folder / "tactile-reference.png")) {
        reference = readTactileReference(dataset);
        from = dataset.folder / "tactile-reference.png";
    }
    for (const SourceFile& source : files) {
        if (!isReference(source.file)) continue;
        const cv::Mat picture = readPhotographFile(source.file, request.decodeOther);
        if (!reference.empty() && !samePixels(picture, reference))
            throw protocols::badInput({"differs from the reference frame " + from.string(), source.file.string(),
                                       "one sensor for each data set",
                                       "import the frames of another sensor into another data set"});
        reference = picture;
        from = source.file;
    }
    return reference;
}

bool isGrey(const cv::Mat& picture)
{
    cv::Mat channels[3];
    cv::split(picture, channels);
    return cv::norm(channels[0], channels[1], cv::NORM_INF) == 0 && cv::norm(channels[1], channels[2], cv::NORM_INF) == 0;
}

constexpr const char* calibrationName = "tactile-calibration.json";

/// Uses the untouched frame of the sensor where the files contain none.
void takeSensor(const ImportedSensor& sensor, const Dataset& dataset, cv::Mat& reference)
{
    const fs::path known = dataset.folder / dataset.tactileCalibration;
    if (!dataset.tactileCalibration.empty() &&
        (dataset.tactileCalibration == "known" || protocols::readWholeFile(known) != sensor.calibration))
        throw protocols::badInput({"its tactile frames have another calibration", known.string(), "one sensor for each data set",
                                   "import the frames of another sensor into another data set"});
    if (reference.empty())
        reference = sensor.untouched;
    else
        sensor.requireSame(reference, "the reference frame");
}

}  // namespace

std::vector<std::string> importPhotos(const ImportRequest& request, ImportStage& stage)
{
    Dataset& dataset = stage.dataset();
    const auto files = sourceFiles(request.from, photographEndings(), FabricNaming::FolderOrFile);
    ImportCounts counts;
    for (const SourceFile& source : files) {
        const cv::Mat picture = readPhotographFile(source.file, request.decodeOther);
        const auto fabric = stage.fabricFor(source.fabricName, request.fabric);
        const auto slot = stage.addSample(fabric, Modality::Visual);
        writePng(slot.file, picture, Sync::Later);
        countSample(counts, fabric, slot.index, picture);
    }
    std::vector<std::string> lines = linesFor(counts, dataset, "photograph", "scale unknown");
    if (auto line = picturesLeftOut(request.from, photographEndings()); !line.empty()) lines.push_back(std::move(line));
    if (dataset.cameraMmPerPixel) {
        lines.push_back("the data set no longer states the scale of the camera (" +
                        protocols::shortest(*dataset.cameraMmPerPixel) +
                        " mm per pixel), because the scale of the new photographs is unknown");
        dataset.cameraMmPerPixel.reset();
    }
    return lines;
}

std::vector<std::string> importGelsight(const ImportRequest& request, ImportStage& stage)
{
    Dataset& dataset = stage.dataset();
    const auto files = sourceFiles(request.from, photographEndings(), FabricNaming::FolderOrFile);
    cv::Mat reference = referenceAmong(files, request, dataset, stage.isNew());
    if (request.sensor) takeSensor(*request.sensor, dataset, reference);
    if (reference.empty() && !stage.isNew() && hasSamples(dataset, Modality::Tactile))
        throw protocols::badInput({"already holds tactile frames but no reference frame", dataset.folder.string(),
                                   "a reference frame of the same sensor", "import into a new data set"});
    cv::Size size = reference.size();
    ImportCounts counts;
    for (const SourceFile& source : files) {
        if (isReference(source.file)) continue;
        const cv::Mat frame = readPhotographFile(source.file, request.decodeOther);
        if (size.area() == 0) size = frame.size();
        if (request.sensor && isGrey(frame))
            throw protocols::badInput({"is a grey image", source.file.string(),
                                       "a colour frame, like the frames of the calibration", "export the frame in colour"});
        if (frame.size() != size)
            throw protocols::badInput(
                {"is " + sizeOf(frame), source.file.string(),
                 std::to_string(size.width) + " x " + std::to_string(size.height) + " px, like the other frames of the sensor",
                 "export all frames at one size"});
        const auto fabric = stage.fabricFor(source.fabricName, request.fabric);
        const auto slot = stage.addSample(fabric, Modality::Tactile);
        writePng(slot.file, frame, Sync::Later);
        countSample(counts, fabric, slot.index, frame);
    }
    if (counts.empty())
        throw protocols::badInput({"contains only reference frames", request.from.front().string(),
                                   "at least one frame of a press", "add frames of presses"});
    if (!reference.empty() && (stage.isNew() || !fs::exists(dataset.folder / "tactile-reference.png")))
        writePng(stage.addFile("tactile-reference.png"), reference, Sync::Later);
    if (request.sensor && dataset.tactileCalibration.empty()) {
        protocols::writeWholeFile(stage.addFile(calibrationName), request.sensor->calibration, Sync::Later);
        dataset.tactileCalibration = calibrationName;
        dataset.tactileMmPerPixel = request.sensor->mmPerPixel;
    }
    std::vector<std::string> lines =
        linesFor(counts, dataset, "tactile frame", dataset.tactileCalibration.empty() ? "sensor not calibrated" : "calibrated");
    if (reference.empty())
        lines.emplace_back(
            "the files contain no reference frame (background.png or reference.png), so heights cannot be computed");
    return lines;
}

}  // namespace rendering::fabrics
