// Figures of an adaptation before and after: on the laboratory's held-out photographs, and on drawn fabrics, for which the model
// was shipped. Only the torch sources include it.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>

#include "rendering/models/lab/lab_cloth.h"
#include "rendering/models/seeing/cloth_steps.h"

namespace rendering::models {

/// What networks make of a photograph, beside what was measured.
struct SeenLabPhotograph {
    std::size_t fabric = 0;
    std::optional<double> logFrictionError;  ///< logarithm of generated over measured mean friction
    double intervalShare = 0;                ///< |logFrictionError| over half the width of the 90 % interval
    std::optional<double> logSqRatio;        ///< logarithm of generated over measured Sq, without slow parts
    std::optional<double> correlation;       ///< with registered relief, without slow parts
};

/// Signals as inference computes them, of the middle of each photograph of a part; at most `most`, evenly spread.
std::vector<SeenLabPhotograph> seenLab(SeeingNetworks& networks, const Architecture& architecture, const LabCloth& lab,
                                       LabPart part, int most);

/// Means over photographs; nullopt where nothing was measured.
struct LabFigures {
    int photographs = 0, fabrics = 0;
    std::optional<double> frictionError;  ///< mean relative error of the mean coefficient
    int frictionPhotographs = 0, insideInterval = 0;
    std::optional<double> sqRatio;  ///< geometric mean of generated over measured
    std::optional<double> sqError;  ///< mean absolute logarithm of that ratio
    std::optional<double> correlation;
    bool operator==(const LabFigures&) const = default;
};
LabFigures labFigures(const std::vector<SeenLabPhotograph>& seen);
nlohmann::ordered_json asJson(const LabFigures& figures);

/// Scales of the lab: friction and relief that it measures over generated ones, from its training photographs. Medians over
/// fabrics, drawn towards 1 where few fabrics tell. 1 where nothing was measured.
struct LabFactors {
    double friction = 1, relief = 1;
};
LabFactors labFactors(const std::vector<SeenLabPhotograph>& training);

/// Mean of the measures after over before, 1 for no change; below 1 is better. `before` and `after` in the same order.
double labScore(const std::vector<LabFigures>& before, const std::vector<LabFigures>& after);

/// A figure on drawn fabrics before and after. Worsening in percent of the figure before, negative where it improved;
/// `atMost`: upper end of its one-sided 95 % interval over the fabrics.
struct ShippedAbility {
    double before = 0, after = 0, worsePercent = 0, atMostPercent = 0;
};
struct ShippedAbilities {
    int fabrics = 0;
    ShippedAbility relief;    ///< mean correlation with the known relief
    ShippedAbility friction;  ///< mean relative error of the mean friction
    double worst() const { return std::max(relief.worsePercent, friction.worsePercent); }
};
/// Both from equal drawn fabrics in equal order.
ShippedAbilities shippedAbilities(const std::vector<SeenPatch>& before, const std::vector<SeenPatch>& after);
nlohmann::ordered_json asJson(const ShippedAbilities& abilities);

}  // namespace rendering::models
