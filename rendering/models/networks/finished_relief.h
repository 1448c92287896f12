// Conversion of G_h's outputs to a height map. Only the torch sources of this folder include it.
#pragma once

#include <torch/torch.h>

#include "rendering/models/architecture.h"
#include "rendering/models/ring_spectrum.h"

namespace rendering::models {

/// Parameters of the filter that imposes a spectrum; more passes come closer to it.
RingFilter ringFilter(const Architecture& architecture, int passes);

/// `relief` [N, 1, H, W] in units of heightScaleMm with the predicted radial power spectra `rings` [N, ringCount] imposed, if
/// the architecture imposes spectra (ring_spectrum.h). Without gradient.
torch::Tensor finishedRelief(const torch::Tensor& relief, const torch::Tensor& rings, const Architecture& architecture);

}  // namespace rendering::models
