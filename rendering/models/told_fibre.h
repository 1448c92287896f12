// What the name of the fibre adds to friction. A photograph shows the relief of cloth, and hardly how smooth or hairy its fibre
// is, which makes over half of the friction of drawn cloth (`bench fabrics`). A label tells it. Drawn fabrics of each fibre
// say, after training, how the friction that the networks read from a photograph is to be corrected. No torch here.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "rendering/fabrics/fibre.h"

namespace rendering::models {

/// Friction of cloth of one fibre: constant + gain x the mean that the networks read.
struct FibreReading {
    double constant = 0;
    double gain = 1;
    double narrowing = 1;  ///< width of the 90 % interval over that without the name, on a logarithmic axis
    bool operator==(const FibreReading&) const = default;
};

/// nullopt for fibres of which too little was drawn.
using FibreReadings = std::array<std::optional<FibreReading>, fabrics::fibreCount>;

/// Friction as the networks read it from a photograph: natural logarithm of the mean, and half of its 90 % interval.
struct ReadFriction {
    double logMean = 0, halfWidth = 0;
};

/// `read` where no fibre is told, or nothing is known of it.
ReadFriction withToldFibre(const ReadFriction& read, const FibreReadings& readings, const std::optional<fabrics::Fibre>& fibre);

/// Logarithm of the mean that networks should read from cloth with this logarithm of the mean, so that withToldFibre() gives it;
/// at most four times as far. NaN stays NaN.
double logMeanToRead(double logFriction, const FibreReadings& readings, const std::optional<fabrics::Fibre>& fibre);

/// A drawn fabric whose friction is known.
struct DrawnReading {
    fabrics::Fibre fibre;
    ReadFriction read;
    double logFriction = 0;
};

/// The lines with the least squares of relative errors, and intervals that hold 90 % of the same fabrics. A fibre needs 40 of
/// them.
FibreReadings fibreReadings(std::span<const DrawnReading> drawn);

}  // namespace rendering::models
