#include "rendering/models/networks/losses.h"

#include "rendering/models/seeing/ring_tensors.h"

namespace rendering::models {

namespace {

namespace functional = torch::nn::functional;

torch::Tensor amplitudes(const torch::Tensor& maps)
{
    return (functional::avg_pool2d(powers(maps), functional::AvgPool2dFuncOptions(3).stride(1).padding(1)) + 1e-6).sqrt();
}

torch::Tensor logRings(const torch::Tensor& maps)
{
    // The constant lies near the noise of the sensor: a hundredth of a unit's deviation over all frequencies.
    return torch::log(ringMeans(maps) + 1e-5);
}

torch::Tensor l1(const torch::Tensor& a, const torch::Tensor& b) { return (a - b).abs().mean(); }

torch::Tensor gaussianMeans(const torch::Tensor& maps)
{
    const torch::Tensor place = torch::arange(11) - 5.0;
    const torch::Tensor kernel = torch::exp(-place.square() / (2 * 1.5 * 1.5));
    const torch::Tensor unit = kernel / kernel.sum();
    return torch::conv2d(torch::conv2d(maps, unit.view({1, 1, 1, 11})), unit.view({1, 1, 11, 1}));
}

/// Sums over all parts of side x side of the windows.
torch::Tensor partSums(const torch::Tensor& windows, std::int64_t side)
{
    const auto pooled = [](const torch::Tensor& image, std::vector<std::int64_t> size) {
        return functional::avg_pool2d(image, functional::AvgPool2dFuncOptions(size).stride(1));
    };
    return pooled(pooled(windows, {side, 1}), {1, side}) * static_cast<double>(side * side);
}

}  // namespace

LossWeights referenceWeights()
{
    LossWeights weights;
    weights.adversary = Adversary::Paper;
    weights.adversarial = 1;
    weights.pixel = 100;
    weights.logRatio = 100;
    weights.mean = 100;
    return weights;
}

LossWeights defaultWeights()
{
    LossWeights weights;
    weights.adversarial = 0.1;
    weights.pixel = 10;
    weights.structure = 5;
    weights.sorted = 20;
    weights.spectrum = 5;
    weights.radial = 1;
    weights.rings = 2;
    weights.logRatio = 2;
    weights.logMean = 10;
    return weights;
}

LossWeights l1OnlyWeights()
{
    LossWeights weights = referenceWeights();
    weights.adversarial = 0;
    return weights;
}

torch::Tensor discriminatorLoss(const torch::Tensor& logitsOfReal, const torch::Tensor& logitsOfGenerated, Adversary adversary)
{
    if (adversary == Adversary::Hinge) return torch::relu(1 - logitsOfReal).mean() + torch::relu(1 + logitsOfGenerated).mean();
    // -log sigmoid(x) = softplus(-x); -log(1 - sigmoid(x)) = softplus(x).
    return torch::softplus(-logitsOfReal).mean() + torch::softplus(logitsOfGenerated).mean();
}

torch::Tensor adversarialLoss(const torch::Tensor& logitsOfGenerated, Adversary adversary)
{
    return adversary == Adversary::Hinge ? -logitsOfGenerated.mean() : torch::softplus(-logitsOfGenerated).mean();
}

Registered registered(const torch::Tensor& maps, const torch::Tensor& windows)
{
    const torch::NoGradGuard noGradient;
    const std::int64_t side = maps.size(3), wide = windows.size(3), places = wide - side + 1;
    if (places == 1) return {windows, torch::ones({maps.size(0)})};
    const torch::Tensor centred = maps.detach() - maps.detach().mean({2, 3}, true);
    const auto transformed = [&](const torch::Tensor& image) { return torch::fft::rfft2(image, c10::IntArrayRef({wide, wide})); };
    const torch::Tensor products =
        torch::fft::irfft2(transformed(windows) * transformed(centred).conj(), c10::IntArrayRef({wide, wide}))
            .narrow(2, 0, places)
            .narrow(3, 0, places);
    const torch::Tensor sums = partSums(windows, side);
    const torch::Tensor spread =
        (partSums(windows.square(), side) - sums.square() / static_cast<double>(side * side)).clamp_min(1e-6).sqrt();
    const torch::Tensor correlations = products / (spread * centred.square().sum({2, 3}, true).sqrt() + 1e-9);
    const auto [best, at] = correlations.flatten(1).max(1);
    std::vector<torch::Tensor> parts;
    for (std::int64_t i = 0; i < maps.size(0); ++i) {
        const auto place = at[i].item<std::int64_t>();
        parts.push_back(windows[i].narrow(1, place / places, side).narrow(2, place % places, side));
    }
    return {torch::stack(parts), best};
}

torch::Tensor ssim(const torch::Tensor& a, const torch::Tensor& b, double range)
{
    const double c1 = 0.01 * 0.01 * range * range, c2 = 0.03 * 0.03 * range * range;
    const torch::Tensor meanA = gaussianMeans(a), meanB = gaussianMeans(b);
    const torch::Tensor varianceA = gaussianMeans(a * a) - meanA * meanA, varianceB = gaussianMeans(b * b) - meanB * meanB;
    const torch::Tensor covariance = gaussianMeans(a * b) - meanA * meanB;
    return ((2 * meanA * meanB + c1) * (2 * covariance + c2) /
            ((meanA * meanA + meanB * meanB + c1) * (varianceA + varianceB + c2)))
        .mean({1, 2, 3});
}

torch::Tensor sortedDistance(const torch::Tensor& a, const torch::Tensor& b)
{
    return l1(std::get<0>(a.flatten(1).sort(1)), std::get<0>(b.flatten(1).sort(1)));
}

torch::Tensor spectrumDistance(const torch::Tensor& a, const torch::Tensor& b) { return l1(amplitudes(a), amplitudes(b)); }

torch::Tensor radialDistance(const torch::Tensor& a, const torch::Tensor& b) { return l1(logRings(a), logRings(b)); }

torch::Tensor distance(const BatchSignals& generated, const BatchSignals& measured, const LossWeights& weights,
                       const DistanceScales& scales)
{
    torch::Tensor sum = weights.logRatio * l1(generated.friction.logRatio, measured.friction.logRatio) +
                        weights.mean / scales.meanFriction * l1(generated.friction.mean, measured.friction.mean) +
                        weights.logMean * l1(generated.friction.mean.log(), measured.friction.mean.log());
    const auto add = [&](double weight, auto distanceOf) {
        if (weight > 0) sum = sum + weight * distanceOf(generated.height, measured.height);
    };
    add(weights.pixel, l1);
    add(weights.structure,
        [&](const torch::Tensor& a, const torch::Tensor& b) { return 1 - ssim(a, b, scales.heightRange).mean(); });
    add(weights.sorted, sortedDistance);
    add(weights.spectrum, spectrumDistance);
    add(weights.radial, radialDistance);
    if (weights.rings > 0) sum = sum + weights.rings * l1(generated.rings, measured.rings);
    return sum;
}

}  // namespace rendering::models
