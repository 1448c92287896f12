// What the generators and the discriminator are told. The paper's: the adversarial losses (1) and (2)
// and the pixel-wise L1 distance (3). Ours differs where pairing is weak: there the measured map lies
// at another place than the photograph, and a pixel-wise distance rewards the flat median map. So
// L1 is taken between what does not depend on the place: the sorted heights, the amplitude spectrum
// and the low-passed map.
// Included by this folder's torch sources only.
#pragma once

#include "rendering/models/networks.h"

namespace rendering::models {

/// Measured or generated signals of a batch.
struct Touch {
    torch::Tensor height;  ///< [N, 1, crop, crop]
    FrictionGuess friction;
};

struct LossWeights {
    double adversarial = 1;
    double pixel = 0, sorted = 0, spectrum = 0, lowPass = 0;  ///< L1 distances of heights
    double logRatio = 0, mean = 0;                            ///< L1 distances of friction
};

/// Eq. 2 + 100 x eq. 3, the weight of pix2pix, to which the paper refers.
LossWeights referenceWeights();
LossWeights defaultWeights();

/// Eq. 1 on logits, averaged over patches.
torch::Tensor discriminatorLoss(const torch::Tensor& logitsOfReal, const torch::Tensor& logitsOfGenerated);
/// Eq. 2 on logits (the non-saturating form).
torch::Tensor adversarialLoss(const torch::Tensor& logitsOfGenerated);
/// The weighted L1 distances.
torch::Tensor distance(const Touch& generated, const Touch& measured, const LossWeights& weights, double meanScale);

/// Mean absolute difference of the sorted values of each map (the Wasserstein-1 distance).
torch::Tensor sortedDistance(const torch::Tensor& a, const torch::Tensor& b);
/// Mean absolute difference of the amplitude spectra, smoothed over 3 x 3 frequencies.
torch::Tensor spectrumDistance(const torch::Tensor& a, const torch::Tensor& b);

}  // namespace rendering::models
