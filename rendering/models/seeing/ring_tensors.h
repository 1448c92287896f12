// The rings of ring_spectrum.h as tensors, for the losses and for the networks' description of a photograph's spectrum.
// Only the torch sources of this folder include it.
#pragma once

#include <torch/torch.h>

namespace rendering::models {

/// Power spectra [N, side, side / 2 + 1] of maps [N, 1, side, side] without their means, under a Hann window. White noise with
/// standard deviation s has a power of about s squared.
torch::Tensor powers(const torch::Tensor& maps);

/// Power averaged over the rings of `side` px, [N, ringCount].
torch::Tensor ringMeans(const torch::Tensor& maps);

}  // namespace rendering::models
