#include "rendering/models/networks.h"

namespace rendering::models {

namespace {

namespace nn = torch::nn;

nn::Conv2d convolution(int in, int out, int size, int stride)
{
    return nn::Conv2d(nn::Conv2dOptions(in, out, size).stride(stride).padding((size - 1) / 2));
}

nn::LeakyReLU leaky() { return nn::LeakyReLU(nn::LeakyReLUOptions().negative_slope(0.2)); }

/// One block of a chain; size 4 halves the picture, size 3 keeps it.
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

nn::Upsample doubling() { return nn::Upsample(nn::UpsampleOptions().scale_factor(std::vector<double>{2, 2}).mode(torch::kNearest)); }

nn::Sequential photographEncoder(int c)
{
    nn::Sequential chain(convolution(3, c, 4, 2), leaky());
    append(chain, c, 2 * c, 4);
    append(chain, 2 * c, 4 * c, 4);
    append(chain, 4 * c, 4 * c, 4);
    return chain;
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

/// Grey against the mean of its surroundings of 31 x 31 px, [N, 1, H, W].
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

/// Zero-centred colours.
torch::Tensor centred(const torch::Tensor& photograph) { return (photograph - 0.5) * 2.0; }

}  // namespace

HeightGeneratorImpl::HeightGeneratorImpl(const Architecture& architecture)
{
    const int c = architecture.baseChannels;
    m_full = register_module("full", nn::Sequential(convolution(3, c, 3, 1), leaky()));
    m_half = register_module("half", halving(c, 2 * c));
    m_quarter = register_module("quarter", halving(2 * c, 4 * c));
    m_eighth = register_module("eighth", halving(4 * c, 4 * c));
    m_sixteenth = register_module("sixteenth", halving(4 * c, 6 * c));
    m_upEighth = register_module("up_eighth", same(10 * c, 4 * c));
    m_upQuarter = register_module("up_quarter", same(8 * c, 2 * c));
    m_upHalf = register_module("up_half", same(4 * c, c));
    m_upFull = register_module("up_full", same(2 * c, c));
    m_out = register_module("out", convolution(c + 1, 1, 3, 1));
    // Weakly paired maps do not tell which way is up: bumps and hollows have the same spectrum. Hollows
    // are darker, so training starts from "brighter is higher".
    const torch::NoGradGuard still;
    m_out->weight[0][c].zero_();
    m_out->weight[0][c][1][1] = 6.0;
}

torch::Tensor HeightGeneratorImpl::forward(const torch::Tensor& photograph)
{
    const torch::Tensor full = m_full->forward(centred(photograph));
    const torch::Tensor half = m_half->forward(full);
    const torch::Tensor quarter = m_quarter->forward(half);
    const torch::Tensor eighth = m_eighth->forward(quarter);
    torch::Tensor up = m_upEighth->forward(torch::cat({doubled(m_sixteenth->forward(eighth)), eighth}, 1));
    up = m_upQuarter->forward(torch::cat({doubled(up), quarter}, 1));
    up = m_upHalf->forward(torch::cat({doubled(up), half}, 1));
    up = m_upFull->forward(torch::cat({doubled(up), full}, 1));
    return torch::softplus(m_out->forward(torch::cat({up, contrast(photograph)}, 1)));
}

FrictionGeneratorImpl::FrictionGeneratorImpl(const Architecture& architecture)
    : m_architecture(architecture), m_seedRows((architecture.rows + 3) / 4), m_seedFrames((architecture.frames + 3) / 4)
{
    const int c = architecture.baseChannels;
    m_encoder = register_module("encoder", photographEncoder(c));
    m_mean = register_module("mean", nn::Linear(8 * c, 1));
    m_seed = register_module("seed", nn::Linear(8 * c, c * m_seedRows * m_seedFrames));
    m_decoder = register_module("decoder", spectrogramDecoder(c));
}

FrictionGuess FrictionGeneratorImpl::forward(const torch::Tensor& photograph)
{
    const torch::Tensor seen = m_encoder->forward(centred(photograph)).flatten(2);
    // Mean and spread of every feature over the photograph: a texture's statistics, wherever it lies.
    const torch::Tensor spread = (seen.var(2, false) + 1e-5).sqrt();
    const torch::Tensor summary = torch::cat({seen.mean(2), spread}, 1);
    const torch::Tensor seed = m_seed->forward(summary).view({-1, m_architecture.baseChannels, m_seedRows, m_seedFrames});
    const torch::Tensor decoded = m_decoder->forward(seed);
    return {decoded.narrow(2, 0, m_architecture.rows).narrow(3, 0, m_architecture.frames),
            torch::softplus(m_mean->forward(summary)) * m_architecture.meanFrictionScale};
}

DiscriminatorImpl::DiscriminatorImpl(const Architecture& architecture)
{
    const int c = architecture.baseChannels;
    m_surface = register_module("surface", nn::Sequential(convolution(4, c, 4, 2), leaky(), convolution(c, 2 * c, 4, 2), leaky(),
                                                          convolution(2 * c, 4 * c, 4, 2), leaky()));
    m_friction = register_module("friction", nn::Sequential(convolution(2, c, 4, 2), leaky(), convolution(c, c, 4, 2), leaky()));
    const int rows = architecture.rows / 2 / 2, frames = architecture.frames / 2 / 2;
    m_frictionOut = register_module("friction_out", nn::Linear(c * rows * frames, 2 * c));
    m_judge = register_module("judge", nn::Sequential(convolution(6 * c, 4 * c, 3, 1), leaky(), convolution(4 * c, 1, 1, 1)));
}

torch::Tensor DiscriminatorImpl::forward(const torch::Tensor& photograph, const FrictionGuess& friction,
                                         const torch::Tensor& height)
{
    const torch::Tensor surface = m_surface->forward(torch::cat({centred(photograph), height}, 1));
    const torch::Tensor mean = friction.mean.view({-1, 1, 1, 1}).expand_as(friction.logRatio);
    const torch::Tensor stroke =
        torch::leaky_relu(m_frictionOut->forward(m_friction->forward(torch::cat({friction.logRatio, mean}, 1)).flatten(1)), 0.2);
    const torch::Tensor everywhere = stroke.view({stroke.size(0), stroke.size(1), 1, 1})
                                         .expand({-1, -1, surface.size(2), surface.size(3)});
    return m_judge->forward(torch::cat({surface, everywhere}, 1));
}

}  // namespace rendering::models
