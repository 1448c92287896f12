#include "rendering/models/seeing/relief_losses.h"

#include <cmath>

#include "rendering/models/seeing/ring_tensors.h"

namespace rendering::models {

namespace {

/// Below this variance (px^2) a map counts as flat, so that flat cloth gives no infinite loss.
constexpr double flatVariance = 1e-4;

/// [length, length]: takes the Gaussian mean along an axis, whose ends are repeated. A matrix, because a convolution with so many
/// taps is slow.
torch::Tensor slowMeans(std::int64_t length)
{
    constexpr int reach = static_cast<int>(2.5 * slowSigmaPx);
    const torch::Tensor place = torch::arange(2 * reach + 1) - static_cast<double>(reach);
    const torch::Tensor weights = torch::exp(-place.square() / (2 * slowSigmaPx * slowSigmaPx));
    const torch::Tensor wide = torch::nn::functional::pad(
        torch::eye(length).unsqueeze(0), torch::nn::functional::PadFuncOptions({reach, reach}).mode(torch::kReplicate));
    return torch::conv1d(wide.transpose(0, 1), (weights / weights.sum()).view({1, 1, -1})).squeeze(1).t().contiguous();
}

/// Mean of each map, [N]. `mask`: [N, 1, H, W], 1 where a point counts; undefined where all do.
torch::Tensor meanOver(const torch::Tensor& maps, const torch::Tensor& mask)
{
    if (!mask.defined()) return maps.mean({1, 2, 3});
    return (maps * mask).sum({1, 2, 3}) / mask.sum({1, 2, 3}).clamp_min(1);
}

torch::Tensor power(const torch::Tensor& maps, const torch::Tensor& mask) { return meanOver(maps.square(), mask); }

/// Differences of neighbours along an axis of the maps, 3 across and 2 down.
torch::Tensor slopesAlong(const torch::Tensor& maps, int axis)
{
    const std::int64_t steps = maps.size(axis) - 1;
    return maps.narrow(axis, 1, steps) - maps.narrow(axis, 0, steps);
}

/// 1 where both neighbours count.
torch::Tensor bothCount(const torch::Tensor& mask, int axis)
{
    if (!mask.defined()) return mask;
    const std::int64_t steps = mask.size(axis) - 1;
    return mask.narrow(axis, 1, steps) * mask.narrow(axis, 0, steps);
}

torch::Tensor slopeDistance(const torch::Tensor& generated, const torch::Tensor& known, const torch::Tensor& mask)
{
    const torch::Tensor steepness =
        (power(slopesAlong(known, 3), bothCount(mask, 3)) + power(slopesAlong(known, 2), bothCount(mask, 2)) + 0.1 * flatVariance)
            .sqrt()
            .view({-1, 1, 1, 1});
    torch::Tensor sum;
    for (const int axis : {3, 2}) {
        const torch::Tensor differences = (slopesAlong(generated, axis) - slopesAlong(known, axis)) / steepness;
        const torch::Tensor distance = meanOver(differences.abs(), bothCount(mask, axis)).mean();
        sum = sum.defined() ? sum + distance : distance;
    }
    return sum;
}

/// Factor that brings each map closest to the known one, [N, 1, 1, 1], without gradient. What a photograph does not tell makes
/// the closest map flat. So distances are measured at this factor, and the deviation has a loss of its own.
torch::Tensor closestFactor(const torch::Tensor& seen, const torch::Tensor& wanted, const torch::Tensor& mask)
{
    constexpr double most = 4;
    return (meanOver(seen * wanted, mask) / (power(seen, mask) + 0.1 * flatVariance))
        .clamp(1 / most, most)
        .view({-1, 1, 1, 1})
        .detach();
}

torch::Tensor correlationOf(const torch::Tensor& a, const torch::Tensor& b, const torch::Tensor& mask)
{
    return meanOver(a * b, mask) / (power(a, mask) * power(b, mask) + 1e-10).sqrt();
}

torch::Tensor slowPart(const torch::Tensor& maps)
{
    return torch::matmul(torch::matmul(slowMeans(maps.size(2)), maps), slowMeans(maps.size(3)).t());
}

/// Without the slow part of the points that count; 0 elsewhere.
torch::Tensor withoutSlowPartOver(const torch::Tensor& maps, const torch::Tensor& mask)
{
    if (!mask.defined()) return maps - slowPart(maps);
    return (maps - slowPart(maps * mask) / slowPart(mask).clamp_min(1e-3)) * mask;
}

torch::Tensor reliefLossOver(const torch::Tensor& generated, const torch::Tensor& known, const ReliefLossWeights& weights,
                             const torch::Tensor& mask)
{
    const torch::Tensor seen = withoutSlowPartOver(generated, mask), wanted = withoutSlowPartOver(known, mask);
    const torch::Tensor deviation = (power(wanted, mask) + flatVariance).sqrt().view({-1, 1, 1, 1});
    const torch::Tensor factor = closestFactor(seen, wanted, mask);
    const torch::Tensor logRatio =
        (power(seen, mask) + 0.1 * flatVariance).log() - (power(wanted, mask) + 0.1 * flatVariance).log();
    torch::Tensor sum = weights.correlation * (1 - correlationOf(seen, wanted, mask)).mean() +
                        weights.height * meanOver(((factor * seen - wanted) / deviation).abs(), mask).mean() +
                        weights.slope * slopeDistance(factor * generated, known, mask) +
                        weights.amplitude * 0.5 * logRatio.abs().mean();
    if (weights.spectrum > 0)
        sum = sum + weights.spectrum * (torch::log(ringMeans(seen) + 1e-5) - torch::log(ringMeans(wanted) + 1e-5)).abs().mean();
    return sum;
}

}  // namespace

torch::Tensor withoutSlowPart(const torch::Tensor& maps) { return withoutSlowPartOver(maps, {}); }

torch::Tensor reliefCorrelation(const torch::Tensor& generated, const torch::Tensor& known)
{
    return correlationOf(withoutSlowPart(generated), withoutSlowPart(known), {});
}

torch::Tensor reliefLoss(const torch::Tensor& generated, const torch::Tensor& known, const ReliefLossWeights& weights)
{
    return reliefLossOver(generated, known, weights, {});
}

torch::Tensor measuredReliefLoss(const torch::Tensor& generated, const torch::Tensor& known, const ReliefLossWeights& weights)
{
    const torch::Tensor measured = torch::isfinite(known);
    return reliefLossOver(generated, torch::where(measured, known, torch::zeros_like(known)), weights,
                          measured.to(torch::kFloat));
}

}  // namespace rendering::models
