// Losses of relief that is known pixel by pixel, in pixels of height. What a high-pass removes is free: a photograph tells
// little of slow waves, and a finger feels little of them.
// Only the torch sources of this folder include it.
#pragma once

#include <torch/torch.h>

#include "rendering/models/seeing/slow_relief.h"

namespace rendering::models {

/// Maps [N, 1, H, W] without their slow part; sides of more than 32 px.
torch::Tensor withoutSlowPart(const torch::Tensor& maps);

/// Correlation of each pair of maps without their slow parts, [N], -1 to 1.
torch::Tensor reliefCorrelation(const torch::Tensor& generated, const torch::Tensor& known);

struct ReliefLossWeights {
    double correlation = 1;  ///< 1 - correlation
    double height = 0.3;     ///< L1 of heights over the known deviation, at the factor that brings them closest
    double slope = 0.3;      ///< L1 of slopes over the known root mean square slope, at the same factor
    double amplitude = 0.3;  ///< absolute logarithm of the ratio of deviations
    double spectrum = 0;     ///< L1 of the logarithms of the radial power spectra, nepers
};

/// Weighted sum, a scalar.
torch::Tensor reliefLoss(const torch::Tensor& generated, const torch::Tensor& known, const ReliefLossWeights& weights);

/// The same over the measured points; `known` has NaN elsewhere.
torch::Tensor measuredReliefLoss(const torch::Tensor& generated, const torch::Tensor& known, const ReliefLossWeights& weights);

}  // namespace rendering::models
