// Batches of cloth as tensors, and the losses of friction. Only the torch sources include it.
#pragma once

#include <torch/torch.h>

#include "rendering/models/seeing/cloth_batches.h"
#include "rendering/models/seeing/seeing_networks.h"

namespace rendering::models {

/// A ClothBatch in its shapes; logRatios is [N, rows x frames].
struct ClothTensors {
    torch::Tensor photographs, reliefs, logPitches, logFrictions, lamps, logRatios;
};
ClothTensors clothTensors(ClothBatch batch);

/// Mean negative log-likelihood of a normal distribution over the patches with known friction; 0 where none has.
torch::Tensor frictionLoss(const SeenFriction& seen, const torch::Tensor& logFrictions);

/// Mean absolute difference over the patches with a stroke; 0 where none has.
torch::Tensor spectrogramLoss(const SeenFriction& seen, const torch::Tensor& logRatios);

}  // namespace rendering::models
