#include "rendering/models/seeing/cloth_tensors.h"

#include "rendering/models/seeing/told_lamp.h"

namespace rendering::models {

namespace {

torch::Tensor shapedTensor(std::vector<float>& values, std::vector<std::int64_t> shape)
{
    return torch::from_blob(values.data(), shape, torch::kFloat).clone();
}

}  // namespace

ClothTensors clothTensors(ClothBatch batch)
{
    return {shapedTensor(batch.photographs, {batch.size, 3, batch.side, batch.side}),
            shapedTensor(batch.reliefs, {batch.size, 1, batch.side, batch.side}),
            shapedTensor(batch.logPitches, {batch.size, 1}),
            shapedTensor(batch.logFrictions, {batch.size, 1}),
            shapedTensor(batch.lamps, {batch.size, lampNumbers}),
            shapedTensor(batch.logRatios, {batch.size, static_cast<std::int64_t>(batch.logRatios.size()) / batch.size})};
}

torch::Tensor frictionLoss(const SeenFriction& seen, const torch::Tensor& logFrictions)
{
    const torch::Tensor known = torch::isfinite(logFrictions);
    const torch::Tensor error = (seen.logMean - torch::where(known, logFrictions, seen.logMean.detach())) / seen.logSpread.exp();
    const torch::Tensor each = torch::where(known, 0.5 * error.square() + seen.logSpread, torch::zeros_like(error));
    return each.sum() / known.sum().clamp_min(1);
}

torch::Tensor spectrogramLoss(const SeenFriction& seen, const torch::Tensor& logRatios)
{
    const torch::Tensor made = seen.logRatio.flatten(1), known = torch::isfinite(logRatios);
    return (made - torch::where(known, logRatios, made.detach())).abs().sum() / known.sum().clamp_min(1);
}

}  // namespace rendering::models
