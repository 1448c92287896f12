// The networks that see cloth instead of recognising it. Scale is physics: slopes have no unit, so a surface and its twofold
// enlargement give the same photograph, and the same heights in pixels. Therefore relief is generated in pixels, and the
// pitch of the photograph turns it into millimetres. Friction depends on lengths, so it is told the pitch.
// Only the torch sources of this folder include it.
#pragma once

#include <torch/torch.h>

#include "rendering/models/architecture.h"

namespace rendering::models {

/// U-Net on a picture whose blocks of 2 x 2 px are the channels of one place; about 140 px see each other. The mean and
/// deviation of its coarsest features tell every place the light and the kind of cloth.
class ReliefNetworkImpl : public torch::nn::Module {
public:
    explicit ReliefNetworkImpl(const Architecture& architecture);
    /// `texture`: seenTexture() [N, 5, H, W], sides multiples of 16; `lamp`: [N, 2] of told_lamp.h. Height in pixels,
    /// [N, 1, H, W], arbitrary zero.
    torch::Tensor forward(const torch::Tensor& texture, const torch::Tensor& lamp);

private:
    torch::nn::Sequential m_half, m_quarter, m_eighth, m_sixteenth, m_upEighth, m_upQuarter, m_upHalf;
    torch::nn::Linear m_light{nullptr};
    torch::nn::Conv2d m_out{nullptr};
};
TORCH_MODULE(ReliefNetwork);

/// Standard deviations on each side of a normal 90 % interval.
inline constexpr double ninetyPercent = 1.6448536269514722;

/// What a photograph tells of friction.
struct SeenFriction {
    torch::Tensor logMean;    ///< [N, 1]: natural logarithm of the coefficient
    torch::Tensor logSpread;  ///< [N, 1]: logarithm of the standard deviation of logMean, 0.02 to 1
    torch::Tensor logRatio;   ///< [N, 1, rows, frames]: spectrogram over its mean (friction_target.h)
};

/// Statistics of texture and relief over a square photograph, and its pitch, lead to friction.
class FrictionNetworkImpl : public torch::nn::Module {
public:
    explicit FrictionNetworkImpl(const Architecture& architecture);
    /// `texture` [N, 5, S, S]; `relief` [N, 1, S, S] in pixels, from which no gradient is taken; `logPitch` [N, 1]: natural
    /// logarithm of millimetres a pixel over pitchUnitMm (pitch_unit.h).
    SeenFriction forward(const torch::Tensor& texture, const torch::Tensor& relief, const torch::Tensor& logPitch);

private:
    Architecture m_architecture;
    int m_seedRows, m_seedFrames;
    torch::nn::Sequential m_half, m_quarter, m_eighth, m_sixteenth, m_decoder;
    torch::nn::Linear m_hidden{nullptr}, m_summary{nullptr}, m_friction{nullptr}, m_seed{nullptr};
};
TORCH_MODULE(FrictionNetwork);

}  // namespace rendering::models
