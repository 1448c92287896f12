// A drawn batch as tensors. Included by this folder's torch sources only.
#pragma once

#include "rendering/models/batches.h"
#include "rendering/models/losses.h"

namespace rendering::models {

struct TensorBatch {
    torch::Tensor photograph;  ///< [N, 3, crop, crop]
    Touch touch;
    Touch other;               ///< validation only
};

inline TensorBatch tensorsOf(Batch batch)
{
    const auto tensor = [](std::vector<float>& values, std::vector<std::int64_t> shape) {
        return torch::from_blob(values.data(), shape, torch::kFloat).clone();
    };
    const auto touch = [&](std::vector<float>& heights, std::vector<float>& logRatios, std::vector<float>& means) {
        if (heights.empty())
            return Touch{};
        return Touch{tensor(heights, {batch.size, 1, batch.crop, batch.crop}),
                     {tensor(logRatios, {batch.size, 1, batch.rows, batch.frames}), tensor(means, {batch.size, 1})}};
    };
    return {tensor(batch.photographs, {batch.size, 3, batch.crop, batch.crop}),
            touch(batch.heights, batch.logRatios, batch.means),
            touch(batch.otherHeights, batch.otherLogRatios, batch.otherMeans)};
}

}  // namespace rendering::models
