// The three networks of the paper's section III as torch modules. The generator G_h turns a photograph into a height map,
// G_s into a spectrogram of the friction coefficient. The discriminator D(x, s, h) takes photograph, spectrogram and height
// map together. Only the torch sources of this folder include it.
#pragma once

#include <torch/torch.h>

#include "rendering/models/architecture.h"

namespace rendering::models {

/// Description of a photograph's texture, independent of the place.
struct Texture {
    torch::Tensor summary;          ///< [N, 4 baseChannels]
    torch::Tensor brightnessRings;  ///< [N, ringCount]: radial power spectrum of the brightness (rings of ring_spectrum.h)
};

/// Four convolutions that halve the photograph [N, 3, side, side] (side a multiple of 16, at least 32). Mean and standard
/// deviation of the features of every scale and the photograph's radial power spectrum go through two linear layers.
class TextureSummaryImpl : public torch::nn::Module {
public:
    explicit TextureSummaryImpl(const Architecture& architecture);
    Texture forward(const torch::Tensor& photograph);

private:
    torch::nn::Sequential m_half, m_quarter, m_eighth, m_sixteenth;
    torch::nn::Linear m_hidden{nullptr}, m_summary{nullptr};
};
TORCH_MODULE(TextureSummary);

/// U-Net, fully convolutional. Input: photograph [N, 3, H, W], 0 to 1, with sides that are multiples of 16. Output: height
/// [N, 1, H, W] >= 0 in units of Architecture::heightScaleMm.
class HeightGeneratorImpl : public torch::nn::Module {
public:
    explicit HeightGeneratorImpl(const Architecture& architecture);
    torch::Tensor forward(const torch::Tensor& photograph);
    /// Predicted radial power spectrum of the height map of a square photograph, [N, ringCount], as ringPowers() computes it.
    torch::Tensor rings(const torch::Tensor& photograph);

private:
    TextureSummary m_summary{nullptr};
    torch::nn::Linear m_rings{nullptr};
    torch::nn::Sequential m_full, m_half, m_quarter, m_eighth, m_sixteenth;
    torch::nn::Sequential m_upEighth, m_upQuarter, m_upHalf, m_upFull;
    torch::nn::Conv2d m_out{nullptr};
};
TORCH_MODULE(HeightGenerator);

/// Outputs of G_s for a photograph.
struct FrictionOutput {
    torch::Tensor logRatio;  ///< [N, 1, rows, frames]: logarithm of magnitude over that of the mean (friction_target.h)
    torch::Tensor mean;      ///< [N, 1]: coefficient of friction, > 0
};

/// Spectrogram from the texture of a square photograph; the mean friction has its own head.
class FrictionGeneratorImpl : public torch::nn::Module {
public:
    explicit FrictionGeneratorImpl(const Architecture& architecture);
    FrictionOutput forward(const torch::Tensor& photograph);

private:
    Architecture m_architecture;
    int m_seedRows, m_seedFrames;
    TextureSummary m_summary{nullptr};
    torch::nn::Sequential m_decoder;
    torch::nn::Linear m_mean{nullptr}, m_seed{nullptr};
};
TORCH_MODULE(FrictionGenerator);

/// Convolution with optional spectral normalisation (Miyato et al. 2018): the weight is divided by its largest singular
/// value, which one power iteration per training pass tracks. Then its gain is at most 1.
class BoundedConvolutionImpl : public torch::nn::Module {
public:
    BoundedConvolutionImpl(int in, int out, std::vector<std::int64_t> size, int stride, bool bounded);
    torch::Tensor forward(const torch::Tensor& input);

private:
    torch::Tensor boundedWeight();
    torch::Tensor m_weight, m_bias, m_direction;
    std::vector<std::int64_t> m_padding;
    int m_stride;
    bool m_bounded;
};
TORCH_MODULE(BoundedConvolution);

/// Logits [N, 1, h, w] for patches of photograph and height map, each combined with the whole spectrogram and mean friction.
class DiscriminatorImpl : public torch::nn::Module {
public:
    /// `bounded`: with spectral normalisation of all convolutions.
    DiscriminatorImpl(const Architecture& architecture, bool bounded);
    torch::Tensor forward(const torch::Tensor& photograph, const FrictionOutput& friction, const torch::Tensor& height);

private:
    torch::nn::Sequential m_surface, m_friction, m_head;
};
TORCH_MODULE(Discriminator);

}  // namespace rendering::models
