// Places of the samples (samples.csv), and the 8:1:1 split over their groups.
#pragma once

#include <cstdint>
#include <map>
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
    std::optional<double> mmPerPixel = {};  ///< of this photograph, where it differs from that of the camera
    std::string light = {};  ///< how this photograph was lit: "one_lamp", "four_lamps", "colour", …; empty where unknown
    std::optional<double> lightDeg = {};  ///< side of a single lamp: 0 right, 90 top, anticlockwise
};
/// Empty where there is no samples.csv. Throws badInput, naming both rows, where a sample is listed twice.
std::vector<SamplePlace> readSamplePlaces(const Dataset& dataset);
/// Writes the columns mm_per_pixel, light and light_deg only where a place has them.
void writeSamplePlaces(const Dataset& dataset, const std::vector<SamplePlace>& places);

/// Scale of a photograph: its own in samples.csv, otherwise that of the camera; nullopt where unknown.
std::optional<double> photographPitch(const Dataset& dataset, const SamplePlace& place);

/// Scale and lamp of all photographs of a data set, read from samples.csv once.
class PhotographViews {
public:
    explicit PhotographViews(const Dataset& dataset);
    std::optional<double> mmPerPixel(const protocols::FabricId& fabric, int index) const;  ///< nullopt where unknown
    std::optional<double> lightDeg(const protocols::FabricId& fabric, int index) const;    ///< SamplePlace::lightDeg

private:
    std::optional<double> m_camera;
    std::map<std::pair<protocols::FabricId, int>, double> m_pitches, m_lights;
};

enum class Part { Training, Validation, Testing };
/// Splits 8:1:1 by seed over groups, for each fabric and signal, before any augmentation or windowing.
/// A fabric with fewer than three groups of a signal has all of them in Training.
std::vector<std::pair<SamplePlace, Part>> splitBySample(const Dataset& dataset, std::uint64_t seed);

/// Name of the group that holds a sample of unknown place alone, such as "F03/visual/17".
std::string ownGroup(const protocols::FabricId& fabric, Modality modality, int index);

}  // namespace rendering::fabrics
