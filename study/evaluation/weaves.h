// Photographs of which nothing was measured: does the generated relief keep the weave, the period and direction of the
// photograph's strongest wave?
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "rendering/signals/dominant_wave.h"
#include "study/evaluation/evaluation.h"

namespace study::evaluation {

struct WeaveKept {
    protocols::FabricId fabric;
    std::string name;
    int index = 0;
    std::optional<rendering::signals::DominantWave> photograph, relief;  ///< none: no wave stands out
    double periodChange = 0;                                             ///< relief over photograph, less 1
    double turnDeg = 0;
    rendering::models::PhotographFacts facts;

    bool comparable() const { return photograph && relief; }
    /// Within 5 % and 5 degrees.
    bool kept() const;
};

struct Weaves {
    std::string dataset, model;
    std::vector<WeaveKept> photographs;
};

inline constexpr double mostPeriodChange = 0.05, mostTurnDeg = 5;

/// Every photograph of the data set, relief and photograph on the same pixels.
Weaves weavesKept(const rendering::fabrics::Dataset& dataset, const EvaluationRequest& request, const Report& report = {},
                  const Generate& generate = rendering::models::generate);

/// Schema vis2hap.evaluation/1.
nlohmann::ordered_json weavesJson(const Weaves& weaves);
std::string weavesText(const Weaves& weaves);

}  // namespace study::evaluation
