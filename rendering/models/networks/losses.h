// What the generators and the discriminator are told. The paper's: the adversarial losses (1) and (2)
// and the pixel-wise L1 distance (3). Ours differs where pairing is weak: there the measured map lies
// at another place than the photograph, and a pixel-wise distance to it rewards the flat median map.
// So the measured map is first shifted to where it fits the generated one best (registered), and the
// distance to that is completed by distances that do not depend on the place.
// Included by this folder's torch sources only.
#pragma once

#include "rendering/models/networks/networks.h"

namespace rendering::models {

/// Measured or generated signals of a batch.
struct Touch {
    torch::Tensor height;  ///< [N, 1, crop, crop]
    torch::Tensor rings;   ///< [N, ringCount]: radial spectrum of the height, measured or as G_h predicts it
    FrictionGuess friction;
};

enum class Adversary {
    Paper,  ///< equations (1) and (2) on logits, the generators' in its non-saturating form
    Hinge   ///< hinge losses on a discriminator with spectral normalisation (Miyato et al. 2018)
};

struct LossWeights {
    Adversary adversary = Adversary::Hinge;
    double adversarial = 0;  ///< 0: no discriminator is trained
    /// L1 distances of heights. `pixel` and `structure` (1 - SSIM) are pixel-wise, the others not.
    double pixel = 0, structure = 0, sorted = 0, spectrum = 0, radial = 0, rings = 0;
    double logRatio = 0, mean = 0, logMean = 0;  ///< L1 distances of friction
};

/// Eq. 2 + 100 x eq. 3, the weight of pix2pix, to which the paper refers.
LossWeights referenceWeights();
LossWeights defaultWeights();
/// Eq. 3 alone: the control that shows what a plain L1 regression learns.
LossWeights l1OnlyWeights();

/// Eq. 1, averaged over patches.
torch::Tensor discriminatorLoss(const torch::Tensor& logitsOfReal, const torch::Tensor& logitsOfGenerated, Adversary adversary);
/// Eq. 2.
torch::Tensor adversarialLoss(const torch::Tensor& logitsOfGenerated, Adversary adversary);

/// What a distance is measured in.
struct DistanceScales {
    double meanFriction = 0.5;
    double heightRange = 2;  ///< dynamic range of SSIM, units of the height maps
};
/// The weighted distances.
torch::Tensor distance(const Touch& generated, const Touch& measured, const LossWeights& weights, const DistanceScales& scales);

/// The part [N, 1, side, side] of each window [N, 1, side + 2 r, side + 2 r] that correlates best with
/// the map [N, 1, side, side]; without gradient.
struct Registered {
    torch::Tensor maps;
    torch::Tensor correlation;  ///< [N], -1..1
};
Registered registered(const torch::Tensor& maps, const torch::Tensor& windows);

/// SSIM of each pair, [N]: Wang et al. 2004, Gaussian 11 x 11, valid windows, population moments.
torch::Tensor ssim(const torch::Tensor& a, const torch::Tensor& b, double range);
/// Mean absolute difference of the sorted values of each map (the Wasserstein-1 distance).
torch::Tensor sortedDistance(const torch::Tensor& a, const torch::Tensor& b);
/// Mean absolute difference of the amplitude spectra, smoothed over 3 x 3 frequencies.
torch::Tensor spectrumDistance(const torch::Tensor& a, const torch::Tensor& b);
/// Mean absolute difference of the logarithms of the radially averaged power spectra, nepers of power.
torch::Tensor radialDistance(const torch::Tensor& a, const torch::Tensor& b);

}  // namespace rendering::models
