// The data set of INTERFACES: photographs, GelSight frames and friction records by fabric. This is
// the reader; dataset_check tells every fault, procedural_fabrics and the importers write.
// Any of the three signals may be missing and their counts may differ.
#pragma once

#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "protocols/ids.h"

namespace rendering::fabrics {

enum class Modality { Visual, Tactile, Friction };
enum class Pairing { Weak, Aligned };

/// "visual", "tactile", "friction": folder names and column values.
std::string nameOf(Modality modality);

struct FabricInfo {
    protocols::FabricId id;
    std::string name;
    std::string structure;  ///< "twill 2/2", "jersey"; empty where unknown
};

/// How the friction records of a data set were taken.
struct FrictionRecording {
    double sampleRateHz = 60;
    double speedMmPerS = 5;
    double lengthMm = 40;
};

struct Dataset {
    std::filesystem::path folder;
    std::string name;
    std::vector<FabricInfo> fabrics;
    std::optional<double> cameraMmPerPixel;
    std::optional<double> tactileMmPerPixel;
    std::string tactileCalibration;  ///< file name in the folder, "known", or empty: heights cannot be had
    FrictionRecording friction;
    Pairing pairing = Pairing::Weak;
    bool procedural = false;
    std::string licence;

    const FabricInfo& fabric(const protocols::FabricId& id) const;  ///< throws badInput naming the ids there are
};

/// Reads dataset.json. Throws badInput naming the file and the field.
Dataset readDataset(const std::filesystem::path& folder);
void writeDatasetJson(const Dataset& dataset);

/// SHA-256 over dataset.json and, in order of path, every sample's path and content hash.
std::string hashOf(const Dataset& dataset);

/// Sample indices present, ascending: visual/007.png is 7.
std::vector<int> sampleIndices(const Dataset& dataset, const protocols::FabricId& fabric, Modality modality);
std::filesystem::path samplePath(const Dataset& dataset, const protocols::FabricId& fabric, Modality modality, int index);
/// Where the known height at the place of a press lies, whether or not it is there.
std::filesystem::path knownHeightPath(const Dataset& dataset, const protocols::FabricId& fabric, int index);

/// CV_8UC3, RGB. Each throws badInput naming the fabric and signal that is missing.
cv::Mat readPhotograph(const Dataset& dataset, const protocols::FabricId& fabric, int index);
cv::Mat readTactileFrame(const Dataset& dataset, const protocols::FabricId& fabric, int index);
cv::Mat readTactileReference(const Dataset& dataset);
/// CV_32FC1, mm; empty optional where the data set has no known heights.
std::optional<cv::Mat> readKnownHeight(const Dataset& dataset, const protocols::FabricId& fabric, int index);

/// A record of a stroke. Either a coefficient, or another quantity under its own name (never "mu").
struct FrictionRecord {
    std::string quantity = "mu";  ///< "mu": coefficient of friction; else e.g. "taxel_sum_counts"
    double sampleRateHz = 60;
    double speedMmPerS = 5;  ///< of the stroke, from the data set
    std::vector<double> timeS;
    std::vector<double> values;  ///< the coefficient T/N, or the quantity
    bool isCoefficient() const { return quantity == "mu"; }
};
/// CSV t_s,normal_n,tangential_n or t_s,mu or t_s,<quantity>. A row with normal force <= 0.05 N is a fault.
FrictionRecord readFriction(const Dataset& dataset, const protocols::FabricId& fabric, int index);

/// One row of samples.csv: where a sample was taken. No split divides a group.
struct SamplePlace {
    protocols::FabricId fabric;
    Modality modality = Modality::Visual;
    int index = 0;
    std::optional<double> xMm, yMm, rotationDeg;
    std::string group;
};
std::vector<SamplePlace> readSamplePlaces(const Dataset& dataset);  ///< empty where there is no samples.csv
void writeSamplePlaces(const Dataset& dataset, const std::vector<SamplePlace>& places);

enum class Part { Training, Validation, Testing };
/// The 8:1:1 split over groups by seed, per fabric and signal; before any augmentation or windowing.
/// A fabric with fewer than three groups of a signal has them all in Training.
std::vector<std::pair<SamplePlace, Part>> splitBySample(const Dataset& dataset, std::uint64_t seed);

}  // namespace rendering::fabrics
