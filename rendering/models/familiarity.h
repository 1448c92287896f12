// Comparison of a photograph with the training photographs: its distance to the nearest of a few hundred of them. The
// threshold is the distance below which nearly all photographs of known fabrics lie. The radial spectra of the known
// fabrics are stored, too. The model card stores these numbers; no libtorch is needed.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <vector>

namespace rendering::models {

/// Every vector has photographFeatureCount numbers, with four significant digits as in the card.
struct Familiarity {
    std::vector<double> mean, deviation;           ///< each feature's mean and standard deviation over the training photographs
    std::vector<std::vector<double>> nearest;      ///< kept training photographs, standardised
    double threshold = 0;                          ///< 99 % of the validation photographs lie below this distance
    std::vector<int> fabricOf;                     ///< fabric of each of `nearest`, from 0; empty if no spectra are stored
    std::vector<std::vector<double>> fabricRings;  ///< for each fabric: mean of ringPowers() over its presses (ring_spectrum.h)
    bool operator==(const Familiarity&) const = default;
};

inline constexpr int mostPhotographsKept = 240;
inline constexpr double familiarShare = 0.99;  ///< share of known fabrics' photographs below the threshold

/// Fabric of each training photograph, and radial spectrum of each fabric.
struct KnownFabrics {
    std::vector<int> fabricOf;
    std::vector<std::vector<double>> rings;
};

/// `training`, `validation`: photographFeatures() of each photograph at the model's pitch. Keeps at most
/// mostPhotographsKept photographs. Each is the one farthest from those already kept, so that rare fabrics remain; no random
/// draw is involved. Without validation photographs, the distances among the kept ones set the threshold. Throws badInput
/// where there are no training photographs or lengths differ.
Familiarity fitFamiliarity(std::span<const std::vector<float>> training, std::span<const std::vector<float>> validation,
                           const KnownFabrics& known = {});

/// Result of a comparison with the known photographs.
struct Recognised {
    double distance = 0;        ///< to the nearest kept photograph, in standard deviations of the training features
    double unfamiliarity = 0;   ///< 0 up to the threshold, 1 from twice the threshold on
    std::vector<double> rings;  ///< weighted mean over similar fabrics; empty where the card stores no spectra
};
/// Throws badInput for another number of features.
Recognised recognised(const Familiarity& familiarity, const std::vector<float>& features);

/// {"features_mean":[..],"features_sd":[..],"nearest":[[..],..],"threshold":X}, and "fabric_of":[..],"fabric_rings":[[..],..]
/// where spectra are stored.
nlohmann::ordered_json familiarityJson(const Familiarity& familiarity);

/// Throws nlohmann's exceptions for wrong types, badInput for impossible lengths or numbers.
Familiarity familiarityFrom(const nlohmann::ordered_json& json);

}  // namespace rendering::models
