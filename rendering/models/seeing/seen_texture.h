// What the networks see of a photograph: its texture without exposure, white balance, uneven light and plain dye.
// Only the torch sources of this folder include it.
#pragma once

#include <torch/torch.h>

namespace rendering::models {

inline constexpr int seenChannels = 5;

/// [N, 5, H, W] from photographs [N, 3, H, W], 0 to 1, sides of at least 16. The channels are, about -4 to 4:
/// the logarithm of brightness relative to its surroundings, divided by its local deviation; the logarithm of this deviation;
/// the first channel before the division; and two contrasts of colour against green. The surroundings are about 64 px wide.
/// A factor on a whole colour channel (exposure, white balance, plain dye) changes nothing but in clipped pixels.
torch::Tensor seenTexture(const torch::Tensor& photograph);

/// [N, 1, H, W]: natural logarithm of brightness relative to its surroundings, which the first channel divides by its deviation.
torch::Tensor seenContrast(const torch::Tensor& photograph);

}  // namespace rendering::models
