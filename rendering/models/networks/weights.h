// The weights file (plain tensors of the two generators, tensor_file.h) and the model card beside it.
// Only the torch sources of this folder include it.
#pragma once

#include <filesystem>

#include "rendering/models/model_card_fields.h"
#include "rendering/models/networks/networks.h"

namespace rendering::models {

struct Generators {
    HeightGenerator height{nullptr};
    FrictionGenerator friction{nullptr};
};

Generators makeGenerators(const Architecture& architecture);

/// Trainable parameters of both generators.
std::vector<torch::Tensor> parametersOf(const Generators& generators);

/// Rounds the parameters to half precision, which the file stores.
void roundToHalf(Generators& generators);

/// Writes parameters in half precision and running statistics in single precision. Sets the card's SHA-256 and writes both
/// files whole or not at all. Throws environmentFault.
void writeModel(const std::filesystem::path& model, Generators& generators, ModelCardFields card);

/// Reads generators in evaluation mode. Throws badInput for a file that is truncated, of another version or layout, altered
/// since its card was written, with other tensors than the networks of the card, or with numbers that are not finite.
Generators readModel(const std::filesystem::path& model, const ModelCardFields& card);

}  // namespace rendering::models
