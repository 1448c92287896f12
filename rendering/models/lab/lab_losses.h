// Losses of relief that a laboratory measured: pixel by pixel where heights are registered with the photograph, else by the
// statistics of presses, which show other places. Only the torch sources include it.
#pragma once

#include <torch/torch.h>

#include "rendering/models/lab/lab_batches.h"

namespace rendering::models {

/// Distance between the power spectra of a generated relief [1, 1, side, side], in pixels, and of presses: L1 of the logarithms
/// of ring powers, and the logarithm of the ratio of deviations, over the waves that the presses resolve. `presses.side` > 0.
torch::Tensor pressLoss(const torch::Tensor& generated, PressWindows presses);

/// Mean loss over the patches with measured relief, a scalar; 0 where none has. `generated`: [N, 1, side, side], pixels.
torch::Tensor labReliefLoss(const torch::Tensor& generated, const torch::Tensor& reliefs, const LabBatch& batch);

}  // namespace rendering::models
