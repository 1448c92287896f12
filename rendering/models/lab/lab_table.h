// The table that an adaptation prints: what it gained for the laboratory, and what the shipped abilities paid for it.
// Only the torch sources include it.
#pragma once

#include <string>

#include "rendering/models/lab/lab_figures.h"

namespace rendering::models {

/// Everything that is known after an adaptation.
struct LabOutcome {
    std::string heldOutFabrics;  ///< "F02 and F05"; empty for none
    LabFigures placesBefore, placesAfter, fabricsBefore, fabricsAfter;
    ShippedAbilities shipped;        ///< without the factors
    double statedFrictionError = 0;  ///< of drawn fabrics, with the lab's factor of friction
    LabFactors factors;              ///< those of this adaptation
    int step = 0;                    ///< whose weights were kept; 0 for the given weights
    double share = 1;                ///< share of the way from the given weights to those of the step
    int candidates = 0;              ///< among which they were chosen
    std::size_t heldOutSeen = 0;     ///< held-out photographs that the given model was trained on (memoryOf())
};

/// One line with its end about held-out photographs that the given model was trained on; empty for none.
std::string memoryOf(std::size_t heldOutSeen, const std::string& given);

/// Several lines, each with its end. `given`, `adapted`: names of the models.
std::string labTable(const LabOutcome& outcome, const std::string& given, const std::string& adapted);

/// For the model card.
nlohmann::ordered_json asJson(const LabOutcome& outcome);

}  // namespace rendering::models
