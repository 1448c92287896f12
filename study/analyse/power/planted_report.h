// The results of `vis2hap power --planted`: what the claims of the report find in studies with a planted difference.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "protocols/protocol.h"
#include "stats/power/planted_claims.h"
#include "stats/power/power_plan.h"

namespace study::analyse {

/// The protocol's design, scale and planned contrasts; `studies` of each truth.
stats::PlantedOptions plantedOptionsOf(const protocols::Protocol& protocol, const stats::PowerOptions& power,
                                       std::size_t studies);

/// Adds "planted": shares between 0 and 1, each with its Monte-Carlo standard error.
void putPlanted(nlohmann::ordered_json& json, const std::vector<stats::PlantedCell>& cells);
/// Prints percentages.
void printPlanted(const std::vector<stats::PlantedCell>& cells);

}  // namespace study::analyse
