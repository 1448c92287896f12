#include "rendering/fabrics/dataset.h"

#include <algorithm>
#include <charconv>

#include "protocols/files/errors.h"
#include "protocols/files/sha256.h"
#include "protocols/files/strict_json.h"
#include "protocols/files/whole_file.h"
#include "rendering/fabrics/dataset_hash.h"
#include "rendering/fabrics/dataset_json.h"
#include "rendering/images/image_png.h"
#include "rendering/images/image_tiff.h"

namespace rendering::fabrics {

namespace fs = std::filesystem;
using protocols::FabricId;

namespace {

constexpr const char* endingOf(Modality modality) { return modality == Modality::Friction ? ".csv" : ".png"; }

std::string sampleName(int index, const char* ending)
{
    std::string digits = std::to_string(index);
    if (digits.size() < 3) digits.insert(0, 3 - digits.size(), '0');
    return digits + ending;
}

/// Throws badInput that names the fabric and the signal where the sample does not exist.
void requireSample(const Dataset& dataset, const FabricId& fabric, Modality modality, int index)
{
    const FabricInfo& info = dataset.fabric(fabric);
    if (fs::exists(samplePath(dataset, fabric, modality, index))) return;
    const auto there = sampleIndices(dataset, fabric, modality);
    const std::string what = there.empty() ? "has no " + nameOf(modality) + " samples"
                                           : "has no " + nameOf(modality) + " sample " + std::to_string(index);
    throw protocols::badInput(
        {"fabric " + fabric.value + (info.name.empty() ? "" : " (" + info.name + ")") + " " + what, dataset.folder.string(),
         there.empty() ? "at least one"
                       : "one of " + std::to_string(there.size()) + " from " + std::to_string(there.front()) + " to " +
                             std::to_string(there.back()),
         there.empty() ? "import that signal, or choose a condition that does not need it" : "choose another sample"});
}

std::optional<cv::Mat> readHeights(const fs::path& file)
{
    if (!fs::exists(file)) return std::nullopt;
    cv::Mat height = readTiff(file);
    if (height.type() != CV_32FC1)
        throw protocols::badInput({"holds integers", file.string(), "32-bit float, mm", "export it as 32-bit float"});
    return height;
}

cv::Mat readColour(const fs::path& file)
{
    cv::Mat image = readPng(file);
    if (image.type() != CV_8UC3)
        throw protocols::badInput(
            {"has " + std::to_string(image.channels()) + " channels of " + std::to_string(8 * image.elemSize1()) + " bits",
             file.string(), "an 8-bit RGB image", "convert it to 8-bit RGB"});
    return image;
}

}  // namespace

std::string nameOf(Modality modality)
{
    switch (modality) {
        case Modality::Visual:
            return "visual";
        case Modality::Tactile:
            return "tactile";
        case Modality::Friction:
            return "friction";
    }
    return {};
}

const FabricInfo& Dataset::fabric(const FabricId& id) const
{
    const auto found = std::find_if(fabrics.begin(), fabrics.end(), [&](const FabricInfo& info) { return info.id == id; });
    if (found != fabrics.end()) return *found;
    std::string known;
    for (const FabricInfo& info : fabrics) known += (known.empty() ? "" : ", ") + info.id.value;
    throw protocols::badInput({"there is no fabric \"" + id.value + "\"", (folder / "dataset.json").string(),
                               known.empty() ? "at least one fabric in the data set" : "one of " + known,
                               known.empty() ? "import or make fabrics first" : "correct the id"});
}

void requireDatasetFolder(const fs::path& folder)
{
    std::error_code problem;
    if (fs::is_regular_file(folder / "dataset.json", problem) || problem == std::errc::permission_denied) return;
    throw protocols::badInput({"is not a data set (dataset.json is missing)", folder.string(), "a data set folder",
                               "make one with `vis2hap fabrics make` or `vis2hap import`"});
}

Dataset readDataset(const fs::path& folder)
{
    requireDatasetFolder(folder);
    const fs::path file = folder / "dataset.json";
    Dataset dataset = datasetFromJson(protocols::readWholeFile(file, protocols::largestJson), file.string());
    dataset.folder = folder;
    return dataset;
}

void writeDatasetJson(const Dataset& dataset)
{
    protocols::writeWholeFile(dataset.folder / "dataset.json", toJson(dataset), protocols::Sync::Later);
}

std::string hashOf(const Dataset& dataset) { return hashOf(dataset, protocols::sha256OfFile); }

std::vector<int> sampleIndices(const Dataset& dataset, const FabricId& fabric, Modality modality)
{
    std::vector<int> indices;
    std::error_code problem;
    const fs::path folder = dataset.folder / fabric.value / nameOf(modality);
    for (fs::directory_iterator entry(folder, problem), end; !problem && entry != end; entry.increment(problem)) {
        const std::string stem = entry->path().stem().string();
        int index = -1;
        const auto [rest, fault] = std::from_chars(stem.data(), stem.data() + stem.size(), index);
        if (fault == std::errc{} && rest == stem.data() + stem.size() && index >= 0 &&
            entry->path().filename().string() == sampleName(index, endingOf(modality)))
            indices.push_back(index);
    }
    std::sort(indices.begin(), indices.end());
    return indices;
}

fs::path samplePath(const Dataset& dataset, const FabricId& fabric, Modality modality, int index)
{
    return dataset.folder / fabric.value / nameOf(modality) / sampleName(index, endingOf(modality));
}

fs::path knownHeightPath(const Dataset& dataset, const FabricId& fabric, int index)
{
    return dataset.folder / fabric.value / "height" / sampleName(index, ".tiff");
}

fs::path surfacePath(const Dataset& dataset, const FabricId& fabric, int index)
{
    return dataset.folder / fabric.value / "surface" / sampleName(index, ".tiff");
}

cv::Mat readPhotograph(const Dataset& dataset, const FabricId& fabric, int index)
{
    requireSample(dataset, fabric, Modality::Visual, index);
    return readColour(samplePath(dataset, fabric, Modality::Visual, index));
}

cv::Mat readTactileFrame(const Dataset& dataset, const FabricId& fabric, int index)
{
    requireSample(dataset, fabric, Modality::Tactile, index);
    return readColour(samplePath(dataset, fabric, Modality::Tactile, index));
}

cv::Mat readTactileReference(const Dataset& dataset)
{
    const fs::path file = dataset.folder / "tactile-reference.png";
    if (!fs::exists(file))
        throw protocols::badInput({"is missing, so heights cannot be computed from the tactile frames", file.string(),
                                   "a frame of the untouched sensor", "import one named background.png or reference.png"});
    return readColour(file);
}

std::optional<cv::Mat> readKnownHeight(const Dataset& dataset, const FabricId& fabric, int index)
{
    return readHeights(knownHeightPath(dataset, fabric, index));
}

std::optional<cv::Mat> readSurface(const Dataset& dataset, const FabricId& fabric, int index)
{
    return readHeights(surfacePath(dataset, fabric, index));
}

std::optional<cv::Mat> readSurfaceOf(const Dataset& dataset, const FabricId& fabric, int index, cv::Size photograph)
{
    std::optional<cv::Mat> surface = readSurface(dataset, fabric, index);
    if (surface && surface->size() != photograph)
        throw protocols::badInput(
            {"the surface has " + std::to_string(surface->cols) + " × " + std::to_string(surface->rows) + " px",
             surfacePath(dataset, fabric, index).string(),
             "the " + std::to_string(photograph.width) + " × " + std::to_string(photograph.height) + " px of its photograph",
             "scale it to the photograph, or remove it"});
    return surface;
}

}  // namespace rendering::fabrics
