#include "rendering/models/networks/networks.h"

#include <algorithm>
#include <cmath>

#include "rendering/models/ring_spectrum.h"
#include "rendering/models/seeing/ring_tensors.h"

namespace rendering::models {

namespace {

namespace nn = torch::nn;

nn::Conv2d convolution(int in, int out, int size, int stride)
{
    return nn::Conv2d(nn::Conv2dOptions(in, out, size).stride(stride).padding((size - 1) / 2));
}

nn::LeakyReLU leaky() { return nn::LeakyReLU(nn::LeakyReLUOptions().negative_slope(0.2)); }

/// Appends a block to a chain; kernel size 4 halves the picture, size 3 keeps its size.
void append(nn::Sequential& chain, int in, int out, int size)
{
    chain->push_back(convolution(in, out, size, size == 4 ? 2 : 1));
    chain->push_back(nn::BatchNorm2d(out));
    chain->push_back(leaky());
}

nn::Sequential halving(int in, int out)
{
    nn::Sequential chain;
    append(chain, in, out, 4);
    return chain;
}

nn::Sequential same(int in, int out)
{
    nn::Sequential chain;
    append(chain, in, out, 3);
    return chain;
}

nn::Upsample doubling()
{
    return nn::Upsample(nn::UpsampleOptions().scale_factor(std::vector<double>{2, 2}).mode(torch::kNearest));
}

nn::Sequential spectrogramDecoder(int c)
{
    nn::Sequential chain(doubling());
    append(chain, c, c, 3);
    chain->push_back(doubling());
    append(chain, c, c, 3);
    chain->push_back(convolution(c, 1, 3, 1));
    return chain;
}

torch::Tensor doubled(const torch::Tensor& image)
{
    return nn::functional::interpolate(
        image, nn::functional::InterpolateFuncOptions().scale_factor(std::vector<double>{2, 2}).mode(torch::kNearest));
}

/// Grey minus the mean of its surroundings of 31 x 31 px, [N, 1, H, W].
torch::Tensor contrast(const torch::Tensor& photograph)
{
    const auto averaged = [](const torch::Tensor& image, std::vector<std::int64_t> window) {
        const std::vector<std::int64_t> padding{window[0] / 2, window[1] / 2};
        return nn::functional::avg_pool2d(
            image, nn::functional::AvgPool2dFuncOptions(window).stride(1).padding(padding).count_include_pad(false));
    };
    const torch::Tensor grey = photograph.mean(1, true);
    return grey - averaged(averaged(grey, {31, 1}), {1, 31});
}

/// Colours centred at zero.
torch::Tensor centred(const torch::Tensor& photograph) { return (photograph - 0.5) * 2.0; }

/// Input of the encoders, [N, 4, H, W]: colours, and the contrast, which does not depend on the brightness of the photograph.
torch::Tensor encoderInput(const torch::Tensor& photograph, const torch::Tensor& contrasted)
{
    return torch::cat({centred(photograph), contrasted * 4}, 1).contiguous(torch::MemoryFormat::ChannelsLast);
}

/// Logarithm of the radial power spectrum of a square photograph's brightness over its mean, about -1 to 1, in the rings of
/// the heights. Waves of the weave are waves of the relief, and convolutions distinguish neighbouring wavelengths less well.
torch::Tensor brightnessRings(const torch::Tensor& photograph)
{
    const torch::Tensor grey = photograph.mean(1, true);
    const torch::Tensor texture = grey / grey.mean({2, 3}, true).clamp_min(0.02);
    return (torch::log(ringMeans(texture) + 1e-5) + 4) / 2;
}

/// Mean and standard deviation of every feature over the photograph: statistics that do not depend on the place.
torch::Tensor statistics(const torch::Tensor& features)
{
    const torch::Tensor flat = features.flatten(2);
    return torch::cat({flat.mean(2), (flat.var(2, false) + 1e-5).sqrt()}, 1);
}

}  // namespace

TextureSummaryImpl::TextureSummaryImpl(const Architecture& architecture)
{
    const int c = architecture.baseChannels;
    m_half = register_module("half", nn::Sequential(convolution(4, c, 4, 2), leaky()));
    m_quarter = register_module("quarter", halving(c, 2 * c));
    m_eighth = register_module("eighth", halving(2 * c, 4 * c));
    m_sixteenth = register_module("sixteenth", halving(4 * c, 4 * c));
    m_hidden = register_module("hidden", nn::Linear(2 * (c + 2 * c + 4 * c + 4 * c) + ringCount, 8 * c));
    m_summary = register_module("summary", nn::Linear(8 * c, 4 * c));
}

Texture TextureSummaryImpl::forward(const torch::Tensor& photograph)
{
    const torch::Tensor half = m_half->forward(encoderInput(photograph, contrast(photograph)));
    const torch::Tensor quarter = m_quarter->forward(half);
    const torch::Tensor eighth = m_eighth->forward(quarter);
    const torch::Tensor sixteenth = m_sixteenth->forward(eighth);
    const torch::Tensor rings = brightnessRings(photograph);
    const torch::Tensor all =
        torch::cat({statistics(half), statistics(quarter), statistics(eighth), statistics(sixteenth), rings}, 1);
    const torch::Tensor hidden = torch::leaky_relu(m_hidden->forward(all), 0.2);
    return {torch::leaky_relu(m_summary->forward(hidden), 0.2), rings};
}

HeightGeneratorImpl::HeightGeneratorImpl(const Architecture& architecture)
{
    const int c = architecture.baseChannels;
    m_summary = register_module("summary", TextureSummary(architecture));
    m_rings = register_module("rings", nn::Linear(4 * c + ringCount, ringCount));
    m_full = register_module("full", nn::Sequential(convolution(4, c, 3, 1), leaky()));
    m_half = register_module("half", halving(c, 2 * c));
    m_quarter = register_module("quarter", halving(2 * c, 4 * c));
    m_eighth = register_module("eighth", halving(4 * c, 4 * c));
    m_sixteenth = register_module("sixteenth", halving(4 * c, 6 * c));
    m_upEighth = register_module("up_eighth", same(10 * c, 4 * c));
    m_upQuarter = register_module("up_quarter", same(8 * c, 2 * c));
    m_upHalf = register_module("up_half", same(4 * c, c));
    m_upFull = register_module("up_full", same(2 * c, c));
    m_out = register_module("out", convolution(c + 1, 1, 3, 1));
    // Weakly paired maps do not determine the sign of the height, because bumps and hollows have the same spectrum.
    // Hollows are darker, so training starts from "brighter is higher".
    const torch::NoGradGuard noGradient;
    m_out->weight[0][c].zero_();
    m_out->weight[0][c][1][1] = 6.0;
}

torch::Tensor HeightGeneratorImpl::forward(const torch::Tensor& photograph)
{
    const torch::Tensor contrasted = contrast(photograph);
    const torch::Tensor full = m_full->forward(encoderInput(photograph, contrasted));
    const torch::Tensor half = m_half->forward(full);
    const torch::Tensor quarter = m_quarter->forward(half);
    const torch::Tensor eighth = m_eighth->forward(quarter);
    torch::Tensor up = m_upEighth->forward(torch::cat({doubled(m_sixteenth->forward(eighth)), eighth}, 1));
    up = m_upQuarter->forward(torch::cat({doubled(up), quarter}, 1));
    up = m_upHalf->forward(torch::cat({doubled(up), half}, 1));
    up = m_upFull->forward(torch::cat({doubled(up), full}, 1));
    return torch::softplus(m_out->forward(torch::cat({up, contrasted}, 1)));
}

torch::Tensor HeightGeneratorImpl::rings(const torch::Tensor& photograph)
{
    // Powers of fabrics lie between the noise of the sensor and a millimetre: logarithms of -14 to 2.
    const Texture texture = m_summary->forward(photograph);
    return 2 * m_rings->forward(torch::cat({texture.summary, texture.brightnessRings}, 1)) - 8;
}

FrictionGeneratorImpl::FrictionGeneratorImpl(const Architecture& architecture)
    : m_architecture(architecture), m_seedRows((architecture.rows + 3) / 4), m_seedFrames((architecture.frames + 3) / 4)
{
    const int c = architecture.baseChannels;
    m_summary = register_module("summary", TextureSummary(architecture));
    m_mean = register_module("mean", nn::Linear(4 * c, 1));
    m_seed = register_module("seed", nn::Linear(4 * c, c * m_seedRows * m_seedFrames));
    m_decoder = register_module("decoder", spectrogramDecoder(c));
}

FrictionOutput FrictionGeneratorImpl::forward(const torch::Tensor& photograph)
{
    const torch::Tensor summary = m_summary->forward(photograph).summary;
    const torch::Tensor seed = m_seed->forward(summary).view({-1, m_architecture.baseChannels, m_seedRows, m_seedFrames});
    const torch::Tensor decoded = m_decoder->forward(seed);
    // The logarithm is learnt, because slipperiness is a ratio. The clamp keeps the output of an untrained network finite.
    return {decoded.narrow(2, 0, m_architecture.rows).narrow(3, 0, m_architecture.frames),
            torch::exp(m_mean->forward(summary).clamp(-8, 8)) * m_architecture.meanFrictionScale};
}

BoundedConvolutionImpl::BoundedConvolutionImpl(int in, int out, std::vector<std::int64_t> size, int stride, bool bounded)
    : m_padding{stride == 0 ? 0 : (size[0] - 1) / 2, stride == 0 ? 0 : (size[1] - 1) / 2},
      m_stride(std::max(1, stride)),
      m_bounded(bounded)
{
    const nn::Conv2d plain(nn::Conv2dOptions(in, out, {size[0], size[1]}));
    m_weight = register_parameter("weight", plain->weight.detach().clone());
    m_bias = register_parameter("bias", plain->bias.detach().clone());
    m_direction = register_buffer("direction", torch::ones({out}) / std::sqrt(static_cast<double>(out)));
}

torch::Tensor BoundedConvolutionImpl::boundedWeight()
{
    const torch::Tensor matrix = m_weight.flatten(1);
    torch::Tensor input;
    {
        const torch::NoGradGuard noGradient;
        const auto unit = [](const torch::Tensor& vector) { return vector / (vector.norm() + 1e-12); };
        input = unit(torch::mv(matrix.t(), m_direction));
        if (is_training()) m_direction.copy_(unit(torch::mv(matrix, input)));
    }
    return m_weight / (torch::dot(m_direction.clone(), torch::mv(matrix, input)) + 1e-12);
}

torch::Tensor BoundedConvolutionImpl::forward(const torch::Tensor& input)
{
    return torch::conv2d(input, m_bounded ? boundedWeight() : m_weight, m_bias, m_stride, m_padding);
}

DiscriminatorImpl::DiscriminatorImpl(const Architecture& architecture, bool bounded)
{
    const int c = architecture.baseChannels;
    const auto layer = [bounded](int in, int out, int size, int stride) {
        return BoundedConvolution(in, out, std::vector<std::int64_t>{size, size}, stride, bounded);
    };
    m_surface = register_module("surface", nn::Sequential(layer(4, c, 4, 2), leaky(), layer(c, 2 * c, 4, 2), leaky(),
                                                          layer(2 * c, 4 * c, 4, 2), leaky()));
    const std::int64_t rows = architecture.rows / 2 / 2, frames = architecture.frames / 2 / 2;
    m_friction = register_module(
        "friction", nn::Sequential(layer(2, c, 4, 2), leaky(), layer(c, c, 4, 2), leaky(),
                                   BoundedConvolution(c, 2 * c, std::vector<std::int64_t>{rows, frames}, 0, bounded), leaky()));
    m_head = register_module("judge", nn::Sequential(layer(6 * c, 4 * c, 3, 1), leaky(), layer(4 * c, 1, 1, 1)));
}

torch::Tensor DiscriminatorImpl::forward(const torch::Tensor& photograph, const FrictionOutput& friction,
                                         const torch::Tensor& height)
{
    const torch::Tensor shown = torch::cat({centred(photograph), height}, 1).contiguous(torch::MemoryFormat::ChannelsLast);
    const torch::Tensor surface = m_surface->forward(shown);
    const torch::Tensor mean = friction.mean.view({-1, 1, 1, 1}).expand_as(friction.logRatio);
    const torch::Tensor stroke = m_friction->forward(torch::cat({friction.logRatio, mean}, 1));
    return m_head->forward(torch::cat({surface, stroke.expand({-1, -1, surface.size(2), surface.size(3)})}, 1));
}

}  // namespace rendering::models
