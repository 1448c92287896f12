// A drawn batch as tensors. Only the torch sources of this folder include it.
#pragma once

#include "rendering/models/networks/batches.h"
#include "rendering/models/networks/losses.h"
#include "rendering/models/ring_spectrum.h"

namespace rendering::models {

struct TensorBatch {
    torch::Tensor photograph;  ///< [N, 3, crop, crop]
    torch::Tensor heights;     ///< [N, 1, crop + 2 margin, crop + 2 margin]
    torch::Tensor rings;       ///< [N, ringCount]
    FrictionOutput friction;
    BatchSignals other;  ///< other measured signals of the same fabrics; for validation only

    /// Measured signals, with the height shifted to the best match with a generated height map.
    BatchSignals measuredFor(const torch::Tensor& generatedHeight) const
    {
        return {registered(generatedHeight, heights).maps, rings, friction};
    }
};

inline TensorBatch tensorsOf(Batch batch)
{
    const auto tensor = [](std::vector<float>& values, std::vector<std::int64_t> shape) {
        return values.empty() ? torch::Tensor() : torch::from_blob(values.data(), shape, torch::kFloat).clone();
    };
    const std::vector<std::int64_t> spectrogram{batch.size, 1, batch.rows, batch.frames};
    const int wide = batch.crop + 2 * batch.margin;
    return {tensor(batch.photographs, {batch.size, 3, batch.crop, batch.crop}),
            tensor(batch.heights, {batch.size, 1, wide, wide}),
            tensor(batch.rings, {batch.size, ringCount}),
            {tensor(batch.logRatios, spectrogram), tensor(batch.means, {batch.size, 1})},
            {tensor(batch.otherHeights, {batch.size, 1, batch.crop, batch.crop}),
             tensor(batch.otherRings, {batch.size, ringCount}),
             {tensor(batch.otherLogRatios, spectrogram), tensor(batch.otherMeans, {batch.size, 1})}}};
}

}  // namespace rendering::models
