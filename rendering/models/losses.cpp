#include "rendering/models/losses.h"

namespace rendering::models {

namespace {

namespace functional = torch::nn::functional;

/// Amplitude spectrum of each map without its mean, under a Hann window, smoothed.
torch::Tensor amplitudes(const torch::Tensor& maps)
{
    const auto side = maps.size(3);
    const torch::Tensor hann = torch::hann_window(side);
    const torch::Tensor centred = maps - maps.mean({2, 3}, true);
    const torch::Tensor transform = torch::fft::rfft2(centred * hann.view({1, 1, side, 1}) * hann.view({1, 1, 1, side}));
    // Scaled so that white noise of deviation s gives about s.
    const torch::Tensor squares = (torch::real(transform).square() + torch::imag(transform).square()) / (0.14 * side * side);
    return (functional::avg_pool2d(squares, functional::AvgPool2dFuncOptions(3).stride(1).padding(1)) + 1e-6).sqrt();
}

torch::Tensor lowPassed(const torch::Tensor& maps)
{
    return functional::avg_pool2d(maps, functional::AvgPool2dFuncOptions(std::min<std::int64_t>(64, maps.size(3))));
}

torch::Tensor l1(const torch::Tensor& a, const torch::Tensor& b) { return (a - b).abs().mean(); }

}  // namespace

LossWeights referenceWeights()
{
    LossWeights weights;
    weights.pixel = 100;
    weights.logRatio = 100;
    weights.mean = 100;
    return weights;
}

LossWeights defaultWeights()
{
    LossWeights weights;
    weights.adversarial = 1;
    weights.sorted = 20;
    weights.spectrum = 10;
    weights.lowPass = 5;
    weights.logRatio = 10;
    weights.mean = 20;
    return weights;
}

torch::Tensor discriminatorLoss(const torch::Tensor& logitsOfReal, const torch::Tensor& logitsOfGenerated)
{
    // -log sigmoid(x) = softplus(-x); -log(1 - sigmoid(x)) = softplus(x).
    return torch::softplus(-logitsOfReal).mean() + torch::softplus(logitsOfGenerated).mean();
}

torch::Tensor adversarialLoss(const torch::Tensor& logitsOfGenerated) { return torch::softplus(-logitsOfGenerated).mean(); }

torch::Tensor sortedDistance(const torch::Tensor& a, const torch::Tensor& b)
{
    return l1(std::get<0>(a.flatten(1).sort(1)), std::get<0>(b.flatten(1).sort(1)));
}

torch::Tensor spectrumDistance(const torch::Tensor& a, const torch::Tensor& b) { return l1(amplitudes(a), amplitudes(b)); }

torch::Tensor distance(const Touch& generated, const Touch& measured, const LossWeights& weights, double meanScale)
{
    torch::Tensor sum = weights.logRatio * l1(generated.friction.logRatio, measured.friction.logRatio) +
                        weights.mean / meanScale * l1(generated.friction.mean, measured.friction.mean);
    if (weights.pixel > 0)
        sum = sum + weights.pixel * l1(generated.height, measured.height);
    if (weights.sorted > 0)
        sum = sum + weights.sorted * sortedDistance(generated.height, measured.height);
    if (weights.spectrum > 0)
        sum = sum + weights.spectrum * spectrumDistance(generated.height, measured.height);
    if (weights.lowPass > 0)
        sum = sum + weights.lowPass * l1(lowPassed(generated.height), lowPassed(measured.height));
    return sum;
}

}  // namespace rendering::models
