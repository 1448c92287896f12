// Whether a photograph is like any that a model was trained on: the distance to the nearest of a few
// hundred of them, against the distance within which nearly all photographs of known fabrics lie.
// Kept in the model card; needs no libtorch.
#pragma once

#include <nlohmann/json.hpp>

#include <span>
#include <vector>

namespace rendering::models {

/// Lengths are photographFeatureCount throughout; numbers have four significant digits, as the card keeps them.
struct Familiarity {
    std::vector<double> mean, deviation;        ///< of each feature over the training photographs
    std::vector<std::vector<double>> nearest;   ///< chosen training photographs, standardised
    double threshold = 0;                       ///< 99 % of the validation photographs lie below it
    bool operator==(const Familiarity&) const = default;
};

inline constexpr int mostPhotographsKept = 240;
inline constexpr double familiarShare = 0.99;  ///< of known fabrics' photographs that lie below the threshold

/// `training`, `validation`: photographFeatures of each photograph, at the model's pitch. Keeps at most
/// mostPhotographsKept photographs, each the farthest from those kept before, so that rare fabrics
/// stay; no draw is involved. Without validation photographs the training ones are compared with each
/// other. Throws badInput for no training photographs or unequal lengths.
Familiarity fitFamiliarity(std::span<const std::vector<float>> training, std::span<const std::vector<float>> validation);

/// To the nearest photograph kept, in standard deviations of the training photographs' features.
/// Throws badInput for another number of features.
double distanceTo(const Familiarity& familiarity, const std::vector<float>& features);

/// {"features_mean":[..],"features_sd":[..],"nearest":[[..],..],"threshold":X}
nlohmann::ordered_json familiarityJson(const Familiarity& familiarity);

/// Throws nlohmann's exceptions for other types, badInput for lengths or numbers that cannot be.
Familiarity familiarityFrom(const nlohmann::ordered_json& json);

}  // namespace rendering::models
