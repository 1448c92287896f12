// Whether a photograph is like any that a model was trained on: the distance to the nearest of a few
// hundred of them, against the distance within which nearly all photographs of known fabrics lie. And
// what is remembered of the fabrics that it is like. Kept in the model card; needs no libtorch.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <vector>

namespace rendering::models {

/// Lengths are photographFeatureCount throughout; numbers have four significant digits, as the card keeps them.
struct Familiarity {
    std::vector<double> mean, deviation;           ///< of each feature over the training photographs
    std::vector<std::vector<double>> nearest;      ///< chosen training photographs, standardised
    double threshold = 0;                          ///< 99 % of the validation photographs lie below it
    std::vector<int> fabricOf;                     ///< of each of `nearest`, counted from 0; empty: nothing is remembered
    std::vector<std::vector<double>> fabricRings;  ///< of each fabric: mean of ringPowers() over its presses (ring_spectrum.h)
    bool operator==(const Familiarity&) const = default;
};

inline constexpr int mostPhotographsKept = 240;
inline constexpr double familiarShare = 0.99;  ///< of known fabrics' photographs that lie below the threshold

/// What is to be remembered: the fabric of each training photograph, and each fabric's rings.
struct KnownFabrics {
    std::vector<int> fabricOf;
    std::vector<std::vector<double>> rings;
};

/// `training`, `validation`: photographFeatures of each photograph, at the model's pitch. Keeps at most
/// mostPhotographsKept photographs, each the farthest from those kept before, so that rare fabrics
/// stay; no draw is involved. Without validation photographs the training ones are compared with each
/// other. Throws badInput for no training photographs or unequal lengths.
Familiarity fitFamiliarity(std::span<const std::vector<float>> training, std::span<const std::vector<float>> validation,
                           const KnownFabrics& known = {});

/// A photograph among those known.
struct Recognised {
    double distance = 0;     ///< to the nearest photograph kept, in standard deviations of the training photographs' features
    double strangeness = 0;  ///< 0 up to the usual distance, 1 from twice that on
    std::vector<double>
        rings;  ///< of the fabrics that look like it, the nearest counting most; empty where nothing is remembered
};
/// Throws badInput for another number of features.
Recognised recognised(const Familiarity& familiarity, const std::vector<float>& features);

/// {"features_mean":[..],"features_sd":[..],"nearest":[[..],..],"threshold":X}, with {"fabric_of":[..],"fabric_rings":[[..],..]}
/// where something is remembered
nlohmann::ordered_json familiarityJson(const Familiarity& familiarity);

/// Throws nlohmann's exceptions for other types, badInput for lengths or numbers that cannot be.
Familiarity familiarityFrom(const nlohmann::ordered_json& json);

}  // namespace rendering::models
