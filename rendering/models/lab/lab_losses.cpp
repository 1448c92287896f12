#include "rendering/models/lab/lab_losses.h"

#include <cmath>

#include "rendering/models/ring_spectrum.h"
#include "rendering/models/seeing/relief_losses.h"
#include "rendering/models/seeing/ring_tensors.h"

namespace rendering::models {

namespace {

/// Weights beside the losses of registered relief.
constexpr double spectrumWeight = 0.3, deviationWeight = 0.5;
constexpr double powerFloor = 1e-5;  ///< px^2, as in reliefLoss()

/// 1 for the frequencies [side, side / 2 + 1] of rfft2 up to `highest` cycles a pixel, but not for the mean.
torch::Tensor resolvedFrequencies(int side, double highest)
{
    const torch::Tensor down = torch::fft::fftfreq(side, 1.0).view({-1, 1}),
                        across = torch::fft::rfftfreq(side, torch::kFloat).view({1, -1});
    const torch::Tensor radius = (down.square() + across.square()).sqrt();
    return ((radius <= highest) * (radius > 0)).to(torch::kFloat);
}

/// Rings below `highest` cycles a pixel, [ringCount], 1 or 0.
torch::Tensor resolvedRings(int side, double highest)
{
    const double most = ringPlace(highest, side);
    return (torch::arange(ringCount) <= most).to(torch::kFloat);
}

/// Columns between both ends of rfft2 stand for two frequencies.
torch::Tensor columnWeights(int side)
{
    torch::Tensor weights = torch::full({side / 2 + 1}, 2.0);
    weights[0] = 1;
    weights[side / 2] = 1;
    return weights;
}

/// Square root of the power [N] at the chosen frequencies.
torch::Tensor logDeviation(const torch::Tensor& maps, const torch::Tensor& chosen)
{
    const auto side = static_cast<int>(maps.size(3));
    const torch::Tensor weights = chosen * columnWeights(side);
    return 0.5 * ((powers(maps) * weights).sum({1, 2}).mean() / weights.sum() + powerFloor).log();
}

torch::Tensor middleOf(const torch::Tensor& maps, std::int64_t side)
{
    const std::int64_t from = (maps.size(2) - side) / 2;
    return maps.narrow(2, from, side).narrow(3, from, side);
}

}  // namespace

torch::Tensor pressLoss(const torch::Tensor& generated, PressWindows presses)
{
    const int side = presses.side;
    // Points without a measurement are 0 and lower the power by their share.
    const torch::Tensor measured =
        torch::from_blob(presses.reliefs.data(), {presses.count, 1, side, side}).clone() / std::sqrt(presses.measured);
    const torch::Tensor seen = middleOf(withoutSlowPart(generated), side);
    const torch::Tensor rings = resolvedRings(side, presses.highestFrequency);
    const torch::Tensor logRatio =
        torch::log(ringMeans(seen).mean(0) + powerFloor) - torch::log(ringMeans(measured).mean(0) + powerFloor);
    const torch::Tensor frequencies = resolvedFrequencies(side, presses.highestFrequency);
    return spectrumWeight * (logRatio.abs() * rings).sum() / rings.sum().clamp_min(1) +
           deviationWeight * (logDeviation(seen, frequencies) - logDeviation(measured, frequencies)).abs();
}

torch::Tensor labReliefLoss(const torch::Tensor& generated, const torch::Tensor& reliefs, const LabBatch& batch)
{
    ReliefLossWeights correlationAlone;
    correlationAlone.height = correlationAlone.slope = correlationAlone.amplitude = 0;
    torch::Tensor sum = torch::zeros({});
    int counted = 0;
    for (int i = 0; i < batch.cloth.size; ++i) {
        const auto at = static_cast<std::size_t>(i);
        const torch::Tensor seen = generated.narrow(0, i, 1), known = reliefs.narrow(0, i, 1);
        if (torch::isfinite(known).any().item<bool>())
            sum = sum + measuredReliefLoss(seen, known, batch.amplitudesKnown[at] != 0 ? ReliefLossWeights{} : correlationAlone);
        else if (batch.presses[at].side > 0)
            sum = sum + pressLoss(seen, batch.presses[at]);
        else
            continue;
        ++counted;
    }
    return sum / std::max(1, counted);
}

}  // namespace rendering::models
