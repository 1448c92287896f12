#include "rendering/models/seeing/relief_losses.h"

#include <cmath>

#include "rendering/models/seeing/ring_tensors.h"

namespace rendering::models {

namespace {

/// Below this variance (px^2) a map counts as flat, so that flat cloth gives no infinite loss.
constexpr double flatVariance = 1e-4;

torch::Tensor slowKernel()
{
    constexpr int reach = static_cast<int>(2.5 * slowSigmaPx);
    const torch::Tensor place = torch::arange(2 * reach + 1) - static_cast<double>(reach);
    const torch::Tensor weights = torch::exp(-place.square() / (2 * slowSigmaPx * slowSigmaPx));
    return weights / weights.sum();
}

torch::Tensor power(const torch::Tensor& maps) { return maps.square().mean({1, 2, 3}); }

torch::Tensor acrossSlopes(const torch::Tensor& maps)
{
    return maps.narrow(3, 1, maps.size(3) - 1) - maps.narrow(3, 0, maps.size(3) - 1);
}

torch::Tensor downSlopes(const torch::Tensor& maps)
{
    return maps.narrow(2, 1, maps.size(2) - 1) - maps.narrow(2, 0, maps.size(2) - 1);
}

torch::Tensor slopeDistance(const torch::Tensor& generated, const torch::Tensor& known)
{
    const torch::Tensor steepness =
        (power(acrossSlopes(known)) + power(downSlopes(known)) + 0.1 * flatVariance).sqrt().view({-1, 1, 1, 1});
    return ((acrossSlopes(generated) - acrossSlopes(known)) / steepness).abs().mean() +
           ((downSlopes(generated) - downSlopes(known)) / steepness).abs().mean();
}

/// Factor that brings each map closest to the known one, [N, 1, 1, 1], without gradient. What a photograph does not tell makes
/// the closest map flat. So distances are measured at this factor, and the deviation has a loss of its own.
torch::Tensor closestFactor(const torch::Tensor& seen, const torch::Tensor& wanted)
{
    constexpr double most = 4;
    return ((seen * wanted).mean({1, 2, 3}) / (power(seen) + 0.1 * flatVariance))
        .clamp(1 / most, most)
        .view({-1, 1, 1, 1})
        .detach();
}

torch::Tensor correlationOf(const torch::Tensor& a, const torch::Tensor& b)
{
    return (a * b).mean({1, 2, 3}) / (power(a) * power(b) + 1e-10).sqrt();
}

}  // namespace

torch::Tensor withoutSlowPart(const torch::Tensor& maps)
{
    const torch::Tensor kernel = slowKernel();
    const std::int64_t taps = kernel.size(0), reach = taps / 2;
    const torch::Tensor wide = torch::nn::functional::pad(
        maps, torch::nn::functional::PadFuncOptions({reach, reach, reach, reach}).mode(torch::kReplicate));
    return maps - torch::conv2d(torch::conv2d(wide, kernel.view({1, 1, 1, taps})), kernel.view({1, 1, taps, 1}));
}

torch::Tensor reliefCorrelation(const torch::Tensor& generated, const torch::Tensor& known)
{
    return correlationOf(withoutSlowPart(generated), withoutSlowPart(known));
}

torch::Tensor reliefLoss(const torch::Tensor& generated, const torch::Tensor& known, const ReliefLossWeights& weights)
{
    const torch::Tensor seen = withoutSlowPart(generated), wanted = withoutSlowPart(known);
    const torch::Tensor deviation = (power(wanted) + flatVariance).sqrt().view({-1, 1, 1, 1});
    const torch::Tensor factor = closestFactor(seen, wanted);
    torch::Tensor sum = weights.correlation * (1 - correlationOf(seen, wanted)).mean() +
                        weights.height * ((factor * seen - wanted) / deviation).abs().mean() +
                        weights.slope * slopeDistance(factor * generated, known) +
                        weights.amplitude * 0.5 *
                            ((power(seen) + 0.1 * flatVariance).log() - (power(wanted) + 0.1 * flatVariance).log()).abs().mean();
    if (weights.spectrum > 0)
        sum = sum + weights.spectrum * (torch::log(ringMeans(seen) + 1e-5) - torch::log(ringMeans(wanted) + 1e-5)).abs().mean();
    return sum;
}

}  // namespace rendering::models
