// The three networks of the paper's section III as torch modules: the generators G_h (photograph ->
// height map) and G_s (photograph -> spectrogram of the friction coefficient), and the one
// discriminator D(x, s, h) that sees photograph, spectrogram and height map together.
// Included by this folder's torch sources only.
#pragma once

#include <torch/torch.h>

#include "rendering/models/architecture.h"

namespace rendering::models {

/// What a photograph's texture is like, wherever it lies.
struct Texture {
    torch::Tensor summary;          ///< [N, 4 baseChannels]
    torch::Tensor brightnessRings;  ///< [N, ringCount]: in the rings in which heights are described (ring_spectrum.h)
};

/// Convolutions that halve the photograph four times, mean and spread of the features of every scale,
/// its radial spectrum, two layers over all. [N, 3, side, side] (a multiple of 16, at least 32).
class TextureSummaryImpl : public torch::nn::Module {
public:
    explicit TextureSummaryImpl(const Architecture& architecture);
    Texture forward(const torch::Tensor& photograph);

private:
    torch::nn::Sequential m_half, m_quarter, m_eighth, m_sixteenth;
    torch::nn::Linear m_hidden{nullptr}, m_summary{nullptr};
};
TORCH_MODULE(TextureSummary);

/// U-Net, fully convolutional. Photograph [N, 3, H, W] in 0..1 with sides that are multiples of 16
/// -> height [N, 1, H, W] >= 0 in units of Architecture::heightScaleMm.
class HeightGeneratorImpl : public torch::nn::Module {
public:
    explicit HeightGeneratorImpl(const Architecture& architecture);
    torch::Tensor forward(const torch::Tensor& photograph);
    /// The radial power spectrum of the height map, [N, ringCount], as ringPowers() of ring_spectrum.h. Of a square photograph.
    torch::Tensor rings(const torch::Tensor& photograph);

private:
    TextureSummary m_summary{nullptr};
    torch::nn::Linear m_rings{nullptr};
    torch::nn::Sequential m_full, m_half, m_quarter, m_eighth, m_sixteenth;
    torch::nn::Sequential m_upEighth, m_upQuarter, m_upHalf, m_upFull;
    torch::nn::Conv2d m_out{nullptr};
};
TORCH_MODULE(HeightGenerator);

/// What G_s says of a photograph.
struct FrictionGuess {
    torch::Tensor logRatio;  ///< [N, 1, rows, frames]: log of magnitude over that of the mean (friction_target.h)
    torch::Tensor mean;      ///< [N, 1]: coefficient of friction, > 0
};

/// From a square photograph's texture the spectrogram and, as a head of its own, the mean friction.
class FrictionGeneratorImpl : public torch::nn::Module {
public:
    explicit FrictionGeneratorImpl(const Architecture& architecture);
    FrictionGuess forward(const torch::Tensor& photograph);

private:
    Architecture m_architecture;
    int m_seedRows, m_seedFrames;
    TextureSummary m_summary{nullptr};
    torch::nn::Sequential m_decoder;
    torch::nn::Linear m_mean{nullptr}, m_seed{nullptr};
};
TORCH_MODULE(FrictionGenerator);

/// A convolution whose weight can be divided by its largest singular value (spectral normalisation,
/// Miyato et al. 2018), followed by one power iteration a training pass; then its gain is at most 1.
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

/// Logits [N, 1, h, w] of patches of the photograph and height map, each judged together with the
/// whole spectrogram and mean friction.
class DiscriminatorImpl : public torch::nn::Module {
public:
    /// `bounded`: with spectral normalisation.
    DiscriminatorImpl(const Architecture& architecture, bool bounded);
    torch::Tensor forward(const torch::Tensor& photograph, const FrictionGuess& friction, const torch::Tensor& height);

private:
    torch::nn::Sequential m_surface, m_friction, m_judge;
};
TORCH_MODULE(Discriminator);

/// Puts the convolutions' weights into the memory order (channels last) in which they run about twice as fast here.
void orderChannelsLast(torch::nn::Module& module);

}  // namespace rendering::models
