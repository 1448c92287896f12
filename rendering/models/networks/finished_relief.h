// From what G_h says of a photograph to the height map. Included by this folder's torch sources only.
#pragma once

#include <torch/torch.h>

#include "rendering/models/architecture.h"
#include "rendering/models/ring_spectrum.h"

namespace rendering::models {

/// How a relief of these networks is brought to its spectrum; the more passes, the nearer.
RingFilter ringFilter(const Architecture& architecture, int passes);

/// `relief` [N, 1, H, W] in units of heightScaleMm brought to the predicted radial spectra `rings`
/// [N, ringCount], where the architecture says so (ring_spectrum.h). Without gradient.
torch::Tensor finishedRelief(const torch::Tensor& relief, const torch::Tensor& rings, const Architecture& architecture);

}  // namespace rendering::models
