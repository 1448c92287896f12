// Evaluation on photographs without measurements: whether the generated relief keeps the weave, given by period, direction and
// share of power of the strongest wave in the photograph.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "rendering/signals/dominant_wave.h"
#include "study/evaluation/evaluation.h"

namespace study::evaluation {

/// Strongest waves of a photograph and of its generated relief.
struct WeaveComparison {
    protocols::FabricId fabric;
    std::string name;
    int index = 0;
    std::optional<rendering::signals::DominantWave> photograph, relief;  ///< none: no clear wave
    double periodChange = 0;                          ///< period of the relief over that of the photograph, minus 1
    double turnDeg = 0;                               ///< angle between the two waves
    double shareOfPhotograph = 0, shareOfRelief = 0;  ///< waveShare() of each at its own wave
    rendering::models::PhotographFacts facts;

    bool comparable() const { return photograph && relief; }
    /// Whether the relief keeps the weave within 5 % and 5°, and has at least a third and at most twice its share of power: a
    /// trace of the weave beneath noise would be no weave to a finger.
    bool kept() const;
};

struct WeaveReport {
    std::string dataset, model;
    std::vector<WeaveComparison> photographs;
    int trainedOn = 0;  ///< photographs that the model was trained on: what it made of them also measures memory
};

inline constexpr double mostPeriodChange = 0.05, mostTurnDeg = 5, leastShareRatio = 1.0 / 3, mostShareRatio = 2;

/// Compares every photograph of the data set with its relief, both on the same pixels.
WeaveReport evaluateWeaves(const rendering::fabrics::Dataset& dataset, const EvaluationRequest& request,
                           const Report& report = {}, const Generate& generate = rendering::models::generate);

/// The report as JSON, schema vis2hap.evaluation/1.
nlohmann::ordered_json weavesJson(const WeaveReport& weaves);
std::string weavesText(const WeaveReport& weaves);

}  // namespace study::evaluation
