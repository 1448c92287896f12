// Reader of a data set: photographs, GelSight frames and friction records, sorted by fabric. dataset_check lists the
// faults of a data set; procedural_fabrics and the importers write data sets.
// Any of the three signals may be missing, and their numbers of samples may differ.
// A photograph may have its surface beside it: the height of the cloth that it shows, pixel by pixel. A known height
// belongs to a press instead, and is pressed cloth.
#pragma once

#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "protocols/ids.h"
#include "rendering/fabrics/fibre.h"

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
    /// False: its surfaces have an unknown amplitude, from 0 to 1, so that they serve for correlation only.
    bool surfaceInMm = true;
    std::optional<Fibre> fibre = {};  ///< as the label says; nullopt where nobody knows, and for mixtures
};

/// How the friction records of a data set were recorded.
struct FrictionRecording {
    double sampleRateHz = 60;
    double speedMmPerS = 5;  ///< of the records that state no speed of their own (ownSpeedMmPerS())
    double lengthMm = 40;    ///< length of a stroke
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
    bool surfaceIsFree = false;  ///< the surfaces show cloth that lies free; a tactile sensor presses it flatter
    std::string licence;

    const FabricInfo& fabric(const protocols::FabricId& id) const;  ///< throws badInput that lists the existing ids
};

/// Throws badInput where the folder has no dataset.json. A folder that may not be searched passes: the reader says so.
void requireDatasetFolder(const std::filesystem::path& folder);

/// Reads dataset.json. Throws badInput naming the file and the field.
Dataset readDataset(const std::filesystem::path& folder);
void writeDatasetJson(const Dataset& dataset);

/// SHA-256 of dataset.json and of the path and content hash of every sample, in order of path. The speed that is stated for a
/// friction record belongs to it.
std::string hashOf(const Dataset& dataset);

/// Existing sample indices, ascending: visual/007.png has index 7.
std::vector<int> sampleIndices(const Dataset& dataset, const protocols::FabricId& fabric, Modality modality);
std::filesystem::path samplePath(const Dataset& dataset, const protocols::FabricId& fabric, Modality modality, int index);
/// Path of the known height at the place of a press; the file need not exist.
std::filesystem::path knownHeightPath(const Dataset& dataset, const protocols::FabricId& fabric, int index);
/// Path of the surface that a photograph shows, F01/surface/000.tiff; the file need not exist.
std::filesystem::path surfacePath(const Dataset& dataset, const protocols::FabricId& fabric, int index);

/// CV_8UC3, RGB. Throws badInput that names the fabric and the missing signal.
cv::Mat readPhotograph(const Dataset& dataset, const protocols::FabricId& fabric, int index);
cv::Mat readTactileFrame(const Dataset& dataset, const protocols::FabricId& fabric, int index);
cv::Mat readTactileReference(const Dataset& dataset);
/// CV_32FC1, mm; nullopt where the data set has no known height. Throws badInput.
std::optional<cv::Mat> readKnownHeight(const Dataset& dataset, const protocols::FabricId& fabric, int index);
/// Height of the cloth that a photograph shows, of its size; positive towards the camera, from an arbitrary zero. CV_32FC1,
/// mm, or without a unit where FabricInfo::surfaceInMm is false. NaN marks points without a measurement. Returns nullopt where
/// there is none. Throws badInput.
std::optional<cv::Mat> readSurface(const Dataset& dataset, const protocols::FabricId& fabric, int index);
/// As readSurface(), and throws badInput where its size is not `photograph`.
std::optional<cv::Mat> readSurfaceOf(const Dataset& dataset, const protocols::FabricId& fabric, int index, cv::Size photograph);

}  // namespace rendering::fabrics
