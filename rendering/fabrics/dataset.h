// Reader of a data set: photographs, GelSight frames and friction records, sorted by fabric. dataset_check lists the
// faults of a data set; procedural_fabrics and the importers write data sets.
// Any of the three signals may be missing, and their numbers of samples may differ.
#pragma once

#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "protocols/ids.h"

namespace rendering::fabrics {

enum class Modality { Visual, Tactile, Friction };
inline constexpr Modality allModalities[] = {Modality::Visual, Modality::Tactile, Modality::Friction};
enum class Pairing { Weak, Aligned };

/// "visual", "tactile", "friction": folder names and column values.
std::string nameOf(Modality modality);

struct FabricInfo {
    protocols::FabricId id;
    std::string name;
    std::string structure;  ///< "twill 2/2", "jersey"; empty where unknown
};

/// How the friction records of a data set were recorded.
struct FrictionRecording {
    double sampleRateHz = 60;
    double speedMmPerS = 5;
    double lengthMm = 40;  ///< length of a stroke
};

struct Dataset {
    std::filesystem::path folder;
    std::string name;
    std::vector<FabricInfo> fabrics;
    std::optional<double> cameraMmPerPixel;
    std::optional<double> tactileMmPerPixel;
    std::string tactileCalibration;  ///< a file name in the folder, or "known"; empty where heights cannot be computed
    FrictionRecording friction;
    Pairing pairing = Pairing::Weak;
    bool procedural = false;
    std::string licence;

    const FabricInfo& fabric(const protocols::FabricId& id) const;  ///< throws badInput that lists the existing ids
};

/// Reads dataset.json. Throws badInput naming the file and the field.
Dataset readDataset(const std::filesystem::path& folder);
void writeDatasetJson(const Dataset& dataset);

/// SHA-256 of dataset.json and of the path and content hash of every sample, in order of path.
std::string hashOf(const Dataset& dataset);

/// Existing sample indices, ascending: visual/007.png has index 7.
std::vector<int> sampleIndices(const Dataset& dataset, const protocols::FabricId& fabric, Modality modality);
std::filesystem::path samplePath(const Dataset& dataset, const protocols::FabricId& fabric, Modality modality, int index);
/// Path of the known height at the place of a press; the file need not exist.
std::filesystem::path knownHeightPath(const Dataset& dataset, const protocols::FabricId& fabric, int index);

/// CV_8UC3, RGB. Throws badInput that names the fabric and the missing signal.
cv::Mat readPhotograph(const Dataset& dataset, const protocols::FabricId& fabric, int index);
cv::Mat readTactileFrame(const Dataset& dataset, const protocols::FabricId& fabric, int index);
cv::Mat readTactileReference(const Dataset& dataset);
/// CV_32FC1, mm; nullopt where the data set has no known height. Throws badInput.
std::optional<cv::Mat> readKnownHeight(const Dataset& dataset, const protocols::FabricId& fabric, int index);

}  // namespace rendering::fabrics
