// The model card: what a weights file says of itself, in JSON beside it (`<weights>.json`), read
// without libtorch. Schema vis2hap.model/2.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "rendering/models/architecture.h"
#include "rendering/models/familiarity.h"
#include "rendering/models/friction_prior.h"
#include "rendering/models/generation.h"

namespace rendering::models {

struct ModelCardFields {
    ModelCard told;  ///< what the rest of the program asks for
    Architecture architecture;
    std::uint64_t seed = 0, splitSeed = 0;
    int steps = 0;
    double trainingMinutes = 0;
    int bestStep = 0;                   ///< at which the weights were kept
    std::string objective = "default";  ///< training.h
    std::string split = "location";     ///< training_data.h
    std::vector<std::string> heldOut;
    std::string datasetName, datasetHash;
    std::string validationJson = "null";             ///< a JSON object: figures before and after training
    std::optional<Familiarity> photographs;          ///< of training; absent: not told
    std::optional<FrictionPrior> frictionByTexture;  ///< absent: the networks alone speak of unfamiliar photographs, too
};

std::filesystem::path cardOf(const std::filesystem::path& model);
std::string cardText(const ModelCardFields& card);

/// Throws badInput naming file and field.
ModelCardFields readModelCardFields(const std::filesystem::path& model);

/// Throws badInput where the weights are missing or not the ones that the card was written for.
void checkWeightsFile(const std::filesystem::path& model, const ModelCardFields& card);

}  // namespace rendering::models
