// The three networks of the paper's section III as torch modules: the generators G_h (photograph ->
// height map) and G_s (photograph -> spectrogram of the friction coefficient), and the one
// discriminator D(x, s, h) that sees photograph, spectrogram and height map together.
// Included by this folder's torch sources only.
#pragma once

#include "rendering/models/architecture.h"

#include <torch/torch.h>

namespace rendering::models {

/// U-Net, fully convolutional. Photograph [N, 3, H, W] in 0..1 with sides that are multiples of 16
/// -> height [N, 1, H, W] >= 0 in units of Architecture::heightScaleMm.
class HeightGeneratorImpl : public torch::nn::Module {
public:
    explicit HeightGeneratorImpl(const Architecture& architecture);
    torch::Tensor forward(const torch::Tensor& photograph);

private:
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

/// Convolutional encoder over a photograph [N, 3, crop, crop], then the spectrogram and, as a head of
/// its own, the mean friction.
class FrictionGeneratorImpl : public torch::nn::Module {
public:
    explicit FrictionGeneratorImpl(const Architecture& architecture);
    FrictionGuess forward(const torch::Tensor& photograph);

private:
    Architecture m_architecture;
    int m_seedRows, m_seedFrames;
    torch::nn::Sequential m_encoder, m_decoder;
    torch::nn::Linear m_mean{nullptr}, m_seed{nullptr};
};
TORCH_MODULE(FrictionGenerator);

/// Logits [N, 1, h, w] of patches of the photograph and height map, each judged together with the
/// whole spectrogram and mean friction.
class DiscriminatorImpl : public torch::nn::Module {
public:
    explicit DiscriminatorImpl(const Architecture& architecture);
    torch::Tensor forward(const torch::Tensor& photograph, const FrictionGuess& friction, const torch::Tensor& height);

private:
    torch::nn::Sequential m_surface, m_friction, m_judge;
    torch::nn::Linear m_frictionOut{nullptr};
};
TORCH_MODULE(Discriminator);

}  // namespace rendering::models
