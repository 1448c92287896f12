// Places of the samples (samples.csv), and the 8:1:1 split over their groups.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "rendering/fabrics/dataset.h"

namespace rendering::fabrics {

/// Row of samples.csv: where a sample was taken. A split keeps the samples of a group together.
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
/// Splits 8:1:1 by seed over groups, for each fabric and signal, before any augmentation or windowing.
/// A fabric with fewer than three groups of a signal has all of them in Training.
std::vector<std::pair<SamplePlace, Part>> splitBySample(const Dataset& dataset, std::uint64_t seed);

/// Name of the group that holds a sample of unknown place alone, such as "F03/visual/17".
std::string ownGroup(const protocols::FabricId& fabric, Modality modality, int index);

}  // namespace rendering::fabrics
