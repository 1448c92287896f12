// Losses of the generators and of the discriminator. The paper's: the adversarial losses (1) and (2) and the pixel-wise
// L1 distance (3). Ours differ for weakly paired data. There the measured map shows another place than the photograph,
// and a pixel-wise distance to it favours the flat median map. So the measured map is first shifted to its best match
// with the generated one (registered). Distances that do not depend on the place are added.
// Only the torch sources of this folder include it.
#pragma once

#include "rendering/models/networks/networks.h"

namespace rendering::models {

/// Measured or generated signals of a batch.
struct BatchSignals {
    torch::Tensor height;  ///< [N, 1, crop, crop]
    torch::Tensor rings;   ///< [N, ringCount]: radial power spectrum of the height, measured or predicted by G_h
    FrictionOutput friction;
};

enum class Adversary {
    Paper,  ///< equations (1) and (2) on logits; the generators' loss in its non-saturating form
    Hinge   ///< hinge losses and a discriminator with spectral normalisation (Miyato et al. 2018)
};

struct LossWeights {
    Adversary adversary = Adversary::Hinge;
    double adversarial = 0;  ///< 0 trains no discriminator
    /// Weights of the L1 distances of heights; `pixel` and `structure` (1 - SSIM) compare pixel by pixel, the others do not.
    double pixel = 0, structure = 0, sorted = 0, spectrum = 0, radial = 0, rings = 0;
    double logRatio = 0, mean = 0, logMean = 0;  ///< weights of the L1 distances of friction
};

/// Eq. 2 + 100 x eq. 3; 100 is the weight of pix2pix, to which the paper refers.
LossWeights referenceWeights();
LossWeights defaultWeights();
/// Eq. 3 alone: a control that shows the result of plain L1 regression.
LossWeights l1OnlyWeights();

/// Eq. 1, averaged over patches.
torch::Tensor discriminatorLoss(const torch::Tensor& logitsOfReal, const torch::Tensor& logitsOfGenerated, Adversary adversary);
/// Eq. 2.
torch::Tensor adversarialLoss(const torch::Tensor& logitsOfGenerated, Adversary adversary);

/// Units of the distances.
struct DistanceScales {
    double meanFriction = 0.5;
    double heightRange = 2;  ///< dynamic range of SSIM, units of the height maps
};
/// Weighted sum of the distances.
torch::Tensor distance(const BatchSignals& generated, const BatchSignals& measured, const LossWeights& weights,
                       const DistanceScales& scales);

/// Part of each window [N, 1, side + 2 r, side + 2 r] that correlates best with the map [N, 1, side, side]. Without
/// gradient.
struct Registered {
    torch::Tensor maps;
    torch::Tensor correlation;  ///< [N], -1 to 1
};
Registered registered(const torch::Tensor& maps, const torch::Tensor& windows);

/// SSIM of each pair, [N]: Wang et al. 2004, Gaussian 11 x 11, valid windows, population moments.
torch::Tensor ssim(const torch::Tensor& a, const torch::Tensor& b, double range);
/// Mean absolute difference between the sorted values of each map (the Wasserstein-1 distance).
torch::Tensor sortedDistance(const torch::Tensor& a, const torch::Tensor& b);
/// Mean absolute difference between the amplitude spectra, which are smoothed over 3 x 3 frequencies.
torch::Tensor spectrumDistance(const torch::Tensor& a, const torch::Tensor& b);
/// Mean absolute difference between the logarithms of the radial power spectra, in nepers of power.
torch::Tensor radialDistance(const torch::Tensor& a, const torch::Tensor& b);

}  // namespace rendering::models
