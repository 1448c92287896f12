// Samples that show the same piece of fabric, and the 8:1:1 split that keeps them together. So no place of the
// test part was photographed, pressed or stroked for training.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "rendering/fabrics/sample_places.h"

namespace rendering::fabrics {

/// Rectangle of fabric that a sample shows.
struct Footprint {
    double xMm = 0, yMm = 0;  ///< its centre
    double widthMm = 0, heightMm = 0;
    double rotationDeg = 0;  ///< angle from the fabric's x axis to the side `widthMm`
    bool operator==(const Footprint&) const = default;
};

/// Photographs and presses: pixels times pitch, centred on their place. Strokes: 1 mm wide, starting at their place. A stroke
/// is as long as its record lasts at its speed; where the record cannot be read, as long as the data set states.
/// Without a rotation the footprint is the square that holds the sample at every angle. Returns nullopt where the place
/// or the pitch is unknown. Throws badInput for a picture that does not begin like a PNG.
std::optional<Footprint> footprintOf(const Dataset& dataset, const SamplePlace& place);

/// True where the rectangles share an area; touching is not enough.
bool overlap(const Footprint& a, const Footprint& b);

/// Splits 8:1:1 by seed. Overlapping samples of one fabric and signal form a group, and so do the groups of samples.csv.
/// Each of validation and testing gets whole groups up to a tenth of the samples; it exceeds a tenth only where the
/// smallest group does. A sample of unknown place overlaps none. A signal with fewer than three groups stays in Training.
std::vector<std::pair<SamplePlace, Part>> splitByLocation(const Dataset& dataset, std::uint64_t seed);

}  // namespace rendering::fabrics
