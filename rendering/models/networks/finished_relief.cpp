#include "rendering/models/networks/finished_relief.h"

#include <opencv2/core.hpp>

#include "rendering/models/preset.h"

namespace rendering::models {

RingFilter ringFilter(const Architecture& architecture, int passes)
{
    RingFilter filter;
    filter.side = architecture.crop;
    filter.passes = passes;
    filter.zeroPercentile = architecture.zeroPercentile;
    return filter;
}

torch::Tensor finishedRelief(const torch::Tensor& relief, const torch::Tensor& rings, const Architecture& architecture)
{
    constexpr int passes = presetOf(Quality::Balanced).spectrumPasses;
    if (!architecture.imposesSpectrum) return relief;
    torch::Tensor finished = relief.detach().contiguous().clone();
    const torch::Tensor wanted = rings.detach().contiguous();
    for (std::int64_t i = 0; i < finished.size(0); ++i) {
        cv::Mat map(static_cast<int>(finished.size(2)), static_cast<int>(finished.size(3)), CV_32F,
                    finished[i].data_ptr<float>());
        const float* first = wanted[i].data_ptr<float>();
        const cv::Mat heightMm =
            withRingPowers(map * architecture.heightScaleMm, {first, first + ringCount}, ringFilter(architecture, passes));
        heightMm.convertTo(map, CV_32F, 1 / architecture.heightScaleMm);
    }
    return finished;
}

}  // namespace rendering::models
