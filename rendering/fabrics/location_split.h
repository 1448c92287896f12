// Which samples show the same piece of fabric, and the 8:1:1 split that keeps such samples together: what is
// tested on was never photographed, pressed or stroked for training.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "rendering/fabrics/dataset.h"

namespace rendering::fabrics {

/// The rectangle of fabric that a sample shows.
struct Footprint {
    double xMm = 0, yMm = 0;  ///< its centre
    double widthMm = 0, heightMm = 0;
    double rotationDeg = 0;  ///< of its width against the fabric's x axis
    bool operator==(const Footprint&) const = default;
};

/// Photographs and presses: pixels times pitch about their place. Strokes: their length from their place on, 1 mm wide.
/// A sample without a rotation gets the square that holds it in any. None where place, pitch or picture size are unknown.
std::optional<Footprint> footprintOf(const Dataset& dataset, const SamplePlace& place);

/// Touching is not overlapping.
bool overlap(const Footprint& a, const Footprint& b);

/// The 8:1:1 split by seed over connected groups of overlapping samples of one fabric and signal, joined with the groups
/// of samples.csv; counts are of samples, as near to a tenth as whole groups come, never above it but where a group alone
/// is. A sample whose place is unknown is a place of its own. Fewer than three groups of a signal are all in Training.
std::vector<std::pair<SamplePlace, Part>> splitByLocation(const Dataset& dataset, std::uint64_t seed);

}  // namespace rendering::fabrics
