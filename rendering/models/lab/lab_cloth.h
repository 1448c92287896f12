// A laboratory's own cloth: photographs with what was measured of it, for the adaptation of a model. The split comes first, so
// that places and whole fabrics stay unseen. No torch here.
//
// What counts as measured relief of a photograph, in this order: its surface (F01/surface/000.tiff); in an aligned data set the
// press of the same index, centre on centre; else any press of the fabric, which shows another place and serves for statistics.
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "rendering/fabrics/dataset.h"
#include "rendering/models/architecture.h"
#include "rendering/models/seeing/cloth_batches.h"
#include "rendering/models/seeing/friction_target.h"

namespace rendering::models {

/// Fewer photographs tell more about themselves than about the camera or the rig.
inline constexpr int fewestLabPhotographs = 10;
/// From this number of measured fabrics on, one in five is held out whole.
inline constexpr int fabricsForHoldingOut = 5;

enum class LabPart { Training, HeldOutPlace, HeldOutFabric };

struct LabPress {
    cv::Mat heightMm;  ///< CV_32FC1 at LabCloth::pressMmPerPixel; NaN where nothing was measured
    LabPart part = LabPart::Training;
};

struct LabStroke {
    FrictionTarget target;  ///< logRatio is NaN at frequencies that the record does not reach
    LabPart part = LabPart::Training;
};

struct LabFabric {
    protocols::FabricId id;
    bool heldOut = false;
    std::vector<LabPress> presses;
    std::vector<LabStroke> strokes;

    /// Logarithm of the mean friction over the strokes of a part; NaN without strokes. A held-out part without strokes of its own
    /// takes all, but training never sees held-out ones.
    double logFriction(LabPart part) const;
};

struct LabPhotograph {
    std::size_t fabric = 0;  ///< in LabCloth::fabrics
    int index = 0;
    LabPart part = LabPart::Training;
    cv::Mat rgb;  ///< CV_8UC3
    double mmPerPixel = 0.05;
    std::optional<double> lightDeg = {};
    std::optional<fabrics::Fibre> fibre = {};
    cv::Mat reliefMm = {};       ///< CV_32FC1 of the same size, NaN where nothing was measured; empty without registered relief
    bool amplitudeKnown = true;  ///< false: `reliefMm` has an unknown scale (FabricInfo::surfaceInMm)
};

struct LabCloth {
    std::vector<LabFabric> fabrics;
    std::vector<LabPhotograph> photographs;  ///< those of which something was measured
    double pressMmPerPixel = 0.05;
    std::vector<std::string> trainingHashes;              ///< SHA-256 of every file of the training part, sorted
    std::set<std::string> heldOutPlaces, heldOutFabrics;  ///< SHA-256 of the photographs of both held-out parts
    std::vector<std::string> notes;                       ///< what was left out and why, one line each

    std::vector<std::size_t> photographsOf(LabPart part) const;
};

struct LabOptions {
    std::uint64_t splitSeed = 1;
    std::vector<protocols::FabricId> heldOut = {};  ///< whole fabrics; empty: drawn by seed
    std::size_t memoryBytes = std::size_t{3} << 30;
};

/// Reads photographs, heights and strokes. A fifth of the places of each fabric is held out, whole groups of overlapping places
/// together (location_split.h). Photographs without a scale get the one that inference assumes. Throws badInput where nothing
/// was measured, or for fewer than fewestLabPhotographs photographs with something measured.
LabCloth readLabCloth(const fabrics::Dataset& dataset, const Architecture& architecture, const LabOptions& options);

/// How many photographs of both held-out parts are among `trainedOn`, the SHA-256 of training files.
std::size_t heldOutAmong(const LabCloth& lab, const std::vector<std::string>& trainedOn);

/// Pictures of `scans` that show what the lab holds out. Held-out photographs are known by the SHA-256 of their files. With one
/// of a held-out fabric go all pictures of that fabric. With one of a held-out place go its group and what overlaps it.
PictureSet scansOfHeldOut(const fabrics::Dataset& scans, const LabCloth& lab);

}  // namespace rendering::models
