// The two networks that see, and their weights file (plain tensors, tensor_file.h) with the model card beside it.
// Only the torch sources include it.
#pragma once

#include <filesystem>
#include <vector>

#include "rendering/models/model_card_fields.h"
#include "rendering/models/seeing/plain_tensors.h"
#include "rendering/models/seeing/seeing_networks.h"

namespace rendering::models {

struct SeeingNetworks {
    ReliefNetwork relief{nullptr};
    FrictionNetwork friction{nullptr};
};

SeeingNetworks makeSeeingNetworks(const Architecture& architecture);

/// Parameters and running statistics of both, in a fixed order; they share their numbers with the networks.
std::vector<NamedTensor> tensorsOf(const std::string& prefix, SeeingNetworks& networks);
std::vector<torch::Tensor> parametersOf(SeeingNetworks& networks);
void setTraining(SeeingNetworks& networks, bool on);

/// Moves `to` towards `from` by `share` of the difference; 1 copies, 0 leaves all as it is.
void moveTowards(SeeingNetworks& to, SeeingNetworks& from, double share);

/// Writes parameters in half precision and running statistics in single precision. Sets the card's SHA-256 and writes both files
/// whole or not at all. Throws environmentFault.
void writeTensorsWithCard(const std::filesystem::path& model, const std::vector<NamedTensor>& tensors, ModelCardFields card);

/// Rounds the parameters to half precision, writes them and the card, whole or not at all. Throws environmentFault.
void writeSeeingModel(const std::filesystem::path& model, SeeingNetworks& networks, ModelCardFields card);

/// Networks in evaluation mode. Throws badInput for a file that is truncated, altered since its card was written, or has other
/// tensors than the networks of the card.
SeeingNetworks readSeeingModel(const std::filesystem::path& model, const ModelCardFields& card);

}  // namespace rendering::models
