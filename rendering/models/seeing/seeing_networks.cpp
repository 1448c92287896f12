#include "rendering/models/seeing/seeing_networks.h"

#include <cmath>

#include "rendering/models/seeing/pitch_unit.h"
#include "rendering/models/seeing/seen_texture.h"
#include "rendering/models/seeing/shared_batch_norm.h"
#include "rendering/models/seeing/told_lamp.h"

namespace rendering::models {

namespace {

namespace nn = torch::nn;
namespace functional = torch::nn::functional;

constexpr double feltMm = 0.15;  ///< smoothing by a fingertip (drawn_friction.h)
constexpr int feltReachPx = 24;
constexpr double leastSigmaPx = 0.3, leastSlope = 0.01;

void append(nn::Sequential& chain, int in, int out, int size = 3, int stride = 1)
{
    chain->push_back(nn::Conv2d(nn::Conv2dOptions(in, out, size).stride(stride).padding((size - 1) / 2).bias(false)));
    chain->push_back(SharedBatchNorm(out));
    chain->push_back(nn::LeakyReLU(nn::LeakyReLUOptions().negative_slope(0.1)));
}

nn::Sequential twice(int in, int out)
{
    nn::Sequential chain;
    append(chain, in, out);
    append(chain, out, out);
    return chain;
}

nn::Sequential once(int in, int out)
{
    nn::Sequential chain;
    append(chain, in, out);
    return chain;
}

nn::Sequential halving(int in, int out)
{
    nn::Sequential chain;
    append(chain, in, out, 4, 2);
    return chain;
}

torch::Tensor halved(const torch::Tensor& features) { return torch::max_pool2d(features, 2); }

torch::Tensor doubled(const torch::Tensor& features)
{
    return functional::interpolate(
        features, functional::InterpolateFuncOptions().scale_factor(std::vector<double>{2, 2}).mode(torch::kNearest));
}

/// Mean and standard deviation of every feature over the picture, [N, 2 C].
torch::Tensor statistics(const torch::Tensor& features)
{
    const torch::Tensor flat = features.flatten(2);
    return torch::cat({flat.mean(2), (flat.var(2, false) + 1e-5).sqrt()}, 1);
}

/// Gaussian kernels [N, 1, 1, taps], as wide as a fingertip feels, for relief of each pitch. Wider than `reach` they are cut.
torch::Tensor feltKernels(const torch::Tensor& logPitch)
{
    const torch::Tensor sigma = (feltMm / pitchUnitMm * (-logPitch).exp()).view({-1, 1}).clamp_min(leastSigmaPx);
    const torch::Tensor place = torch::arange(-feltReachPx, feltReachPx + 1).to(torch::kFloat).view({1, -1});
    const torch::Tensor weights = torch::exp(-place.square() / (2 * sigma.square()));
    return (weights / weights.sum(1, true)).view({logPitch.size(0), 1, 1, -1});
}

/// Logarithm of the RMS slope that a fingertip feels: friction by ploughing grows with it. [N, 1] from relief [N, 1, H, W] in px.
torch::Tensor feltSlope(const torch::Tensor& relief, const torch::Tensor& logPitch)
{
    const torch::Tensor kernels = feltKernels(logPitch);
    const std::int64_t count = relief.size(0);
    torch::Tensor smooth =
        functional::pad(relief.transpose(0, 1),
                        functional::PadFuncOptions({feltReachPx, feltReachPx, feltReachPx, feltReachPx}).mode(torch::kReflect));
    const auto inGroups = functional::Conv2dFuncOptions().groups(count);
    smooth = functional::conv2d(functional::conv2d(smooth, kernels, inGroups), kernels.transpose(2, 3), inGroups);
    const torch::Tensor across = smooth.narrow(3, 1, smooth.size(3) - 1) - smooth.narrow(3, 0, smooth.size(3) - 1);
    const torch::Tensor down = smooth.narrow(2, 1, smooth.size(2) - 1) - smooth.narrow(2, 0, smooth.size(2) - 1);
    return (0.5 * (across.square().mean({2, 3}) + down.square().mean({2, 3})) + leastSlope * leastSlope).log().transpose(0, 1);
}

nn::Upsample upsampling()
{
    return nn::Upsample(nn::UpsampleOptions().scale_factor(std::vector<double>{2, 2}).mode(torch::kNearest));
}

nn::Sequential spectrogramDecoder(int c)
{
    nn::Sequential chain(upsampling());
    append(chain, c, c);
    chain->push_back(upsampling());
    append(chain, c, c);
    chain->push_back(nn::Conv2d(nn::Conv2dOptions(c, 1, 3).padding(1)));
    return chain;
}

}  // namespace

ReliefNetworkImpl::ReliefNetworkImpl(const Architecture& architecture)
{
    const int c = architecture.baseChannels;
    m_half = register_module("half", twice(4 * (seenChannels + lampNumbers), c));
    m_quarter = register_module("quarter", twice(c, 2 * c));
    m_eighth = register_module("eighth", twice(2 * c, 3 * c));
    m_sixteenth = register_module("sixteenth", twice(3 * c, 4 * c));
    m_light = register_module("light", nn::Linear(8 * c + lampNumbers, 4 * c));
    m_upEighth = register_module("up_eighth", once(7 * c, 3 * c));
    m_upQuarter = register_module("up_quarter", once(5 * c, 2 * c));
    m_upHalf = register_module("up_half", twice(3 * c, c));
    m_out = register_module("out", nn::Conv2d(nn::Conv2dOptions(c, 4, 3).padding(1)));
}

torch::Tensor ReliefNetworkImpl::forward(const torch::Tensor& texture, const torch::Tensor& lamp)
{
    const torch::Tensor everywhere = lamp.unsqueeze(2).unsqueeze(3).expand({-1, -1, texture.size(2), texture.size(3)});
    const torch::Tensor blocks =
        torch::pixel_unshuffle(torch::cat({texture, everywhere}, 1), 2).contiguous(torch::MemoryFormat::ChannelsLast);
    const torch::Tensor half = m_half->forward(blocks);
    const torch::Tensor quarter = m_quarter->forward(halved(half));
    const torch::Tensor eighth = m_eighth->forward(halved(quarter));
    torch::Tensor features = m_sixteenth->forward(halved(eighth));
    features = features + m_light->forward(torch::cat({statistics(features), lamp}, 1)).unsqueeze(2).unsqueeze(3);
    features = m_upEighth->forward(torch::cat({doubled(features), eighth}, 1));
    features = m_upQuarter->forward(torch::cat({doubled(features), quarter}, 1));
    features = m_upHalf->forward(torch::cat({doubled(features), half}, 1));
    return torch::pixel_shuffle(m_out->forward(features), 2);
}

FrictionNetworkImpl::FrictionNetworkImpl(const Architecture& architecture)
    : m_architecture(architecture), m_seedRows((architecture.rows + 3) / 4), m_seedFrames((architecture.frames + 3) / 4)
{
    const int c = architecture.frictionChannels;
    m_half = register_module("half", halving(seenChannels + 1, c));
    m_quarter = register_module("quarter", halving(c, 2 * c));
    m_eighth = register_module("eighth", halving(2 * c, 4 * c));
    m_sixteenth = register_module("sixteenth", halving(4 * c, 4 * c));
    m_hidden = register_module("hidden", nn::Linear(2 * (seenChannels + 1 + c + 2 * c + 4 * c + 4 * c) + 2, 8 * c));
    m_summary = register_module("summary", nn::Linear(8 * c, 4 * c));
    m_friction = register_module("friction", nn::Linear(4 * c, 2));
    m_seed = register_module("seed", nn::Linear(4 * c, c * m_seedRows * m_seedFrames));
    m_decoder = register_module("decoder", spectrogramDecoder(c));
}

SeenFriction FrictionNetworkImpl::forward(const torch::Tensor& texture, const torch::Tensor& relief,
                                          const torch::Tensor& logPitch)
{
    const torch::Tensor centred = relief.detach() - relief.detach().mean({2, 3}, true);
    const torch::Tensor seen = torch::cat({texture, centred}, 1).contiguous(torch::MemoryFormat::ChannelsLast);
    const torch::Tensor half = m_half->forward(seen), quarter = m_quarter->forward(half);
    const torch::Tensor eighth = m_eighth->forward(quarter), sixteenth = m_sixteenth->forward(eighth);
    const torch::Tensor all = torch::cat({statistics(seen), statistics(half), statistics(quarter), statistics(eighth),
                                          statistics(sixteenth), logPitch, feltSlope(centred, logPitch)},
                                         1);
    const torch::Tensor summary = torch::leaky_relu(m_summary->forward(torch::leaky_relu(m_hidden->forward(all), 0.1)), 0.1);
    const torch::Tensor friction = m_friction->forward(summary);
    const torch::Tensor seed = m_seed->forward(summary).view({-1, m_architecture.frictionChannels, m_seedRows, m_seedFrames});
    const torch::Tensor decoded = m_decoder->forward(seed);
    return {friction.narrow(1, 0, 1).clamp(-5, 2) - 1, friction.narrow(1, 1, 1).clamp(-2, 2) - 2,
            decoded.narrow(2, 0, m_architecture.rows).narrow(3, 0, m_architecture.frames)};
}

}  // namespace rendering::models
