// The model card: the JSON file beside a weights file (`<weights>.json`) that describes the model, read without libtorch.
// Schema vis2hap.model/2. Cards of version 0.5.0 also list known photographs and fabrics; these are not read any more.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "rendering/models/architecture.h"
#include "rendering/models/model_card.h"
#include "rendering/models/tensors/tensor_file.h"

namespace rendering::models {

struct ModelCardFields {
    ModelCard summary;  ///< the part for the rest of the program
    Architecture architecture;
    std::uint64_t seed = 0, splitSeed = 0;
    int steps = 0;
    double trainingMinutes = 0;
    int bestStep = 0;                   ///< step whose weights were kept
    std::string objective = "default";  ///< training.h
    std::string split = "location";     ///< training_data.h
    std::vector<std::string> heldOut;
    std::string datasetName, datasetHash;
    std::string fromName, fromHash;       ///< the model that training started from, and the hash of its weights; empty for none
    std::string validationJson = "null";  ///< a JSON object: figures before and after training
};

std::filesystem::path cardOf(const std::filesystem::path& model);
std::string cardText(const ModelCardFields& card);

/// Throws badInput naming file and field.
ModelCardFields readModelCardFields(const std::filesystem::path& model);

/// Throws badInput where the weights are missing, no regular file, an archive of version 0.5.0 or larger than 1 GiB, or where
/// their hash differs from the card's.
void checkWeightsFile(const std::filesystem::path& model, const ModelCardFields& card);

/// Throws badInput where the hash of the bytes of a weights file differs from the card's.
void requireHashOfCard(const std::filesystem::path& model, std::string_view bytes, const ModelCardFields& card);

/// How errors name a weights file.
TensorSource weightsSource(const std::filesystem::path& model);

}  // namespace rendering::models
