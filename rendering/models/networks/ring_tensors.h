// The rings of ring_spectrum.h as tensors: for the losses, and for what the networks are told of a
// photograph's spectrum.
// Included by this folder's torch sources only.
#pragma once

#include <torch/torch.h>

namespace rendering::models {

/// Power spectra [N, side, side / 2 + 1] of maps [N, 1, side, side] about their means, under a Hann window.
/// Scaled so that white noise of deviation s gives about s squared.
torch::Tensor powers(const torch::Tensor& maps);

/// The same averaged over the rings of `side` px, [N, ringCount].
torch::Tensor ringMeans(const torch::Tensor& maps);

}  // namespace rendering::models
