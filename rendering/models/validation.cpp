#include "rendering/models/validation.h"

#include "rendering/models/batch_tensors.h"

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

namespace rendering::models {

namespace {

using Sums = std::map<std::string, double>;

/// Best normalised correlation of the middle of `map` with any place of `other`.
double registeredCorrelation(const torch::Tensor& map, const torch::Tensor& other)
{
    const auto mat = [](const torch::Tensor& tensor) {
        const torch::Tensor flat = tensor.contiguous();
        return cv::Mat(static_cast<int>(flat.size(0)), static_cast<int>(flat.size(1)), CV_32F, flat.data_ptr<float>()).clone();
    };
    const cv::Mat whole = mat(map), within = mat(other);
    const cv::Mat middle = whole(cv::Rect(whole.cols / 4, whole.rows / 4, whole.cols / 2, whole.rows / 2));
    cv::Mat correlation;
    cv::matchTemplate(within, middle, correlation, cv::TM_CCOEFF_NORMED);
    double best = 0;
    cv::minMaxLoc(correlation, nullptr, &best);
    return std::isfinite(best) ? best : 0;
}

void add(Sums& sums, const Touch& candidate, const Touch& measured, double heightScaleMm)
{
    const auto count = static_cast<double>(measured.height.size(0));
    const auto put = [&](const char* name, const torch::Tensor& mean, double scale) {
        sums[name] += mean.item<double>() * scale * count;
    };
    put("height_l1_mm", (candidate.height - measured.height).abs().mean(), heightScaleMm);
    put("height_sorted_l1_mm", sortedDistance(candidate.height, measured.height), heightScaleMm);
    put("height_spectrum_l1_mm", spectrumDistance(candidate.height, measured.height), heightScaleMm);
    put("height_deviation_mm", candidate.height.flatten(1).std(1).mean(), heightScaleMm);
    put("log_ratio_l1", (candidate.friction.logRatio - measured.friction.logRatio).abs().mean(), 1);
    put("mean_friction_relative_error",
        ((candidate.friction.mean - measured.friction.mean) / measured.friction.mean).abs().mean(), 1);
    for (std::int64_t i = 0; i < measured.height.size(0); ++i)
        sums["height_registered_correlation"] += registeredCorrelation(candidate.height[i][0], measured.height[i][0]);
}

/// Enough places to compare by.
double shortened(double value) { return std::round(value * 1e6) / 1e6; }

}  // namespace

nlohmann::ordered_json validationFigures(const TrainingData& data, Generators& generators, int pairs, protocols::Random& random)
{
    const torch::NoGradGuard still;
    generators.height->eval();
    generators.friction->eval();
    Sums generated, measured;
    const int step = 4;
    int drawn = 0;
    for (; drawn < pairs; drawn += step) {
        const TensorBatch batch = tensorsOf(drawBatch(data, data.validation, step, false, random));
        const Touch guess{generators.height->forward(batch.photograph), generators.friction->forward(batch.photograph)};
        add(generated, guess, batch.touch, data.architecture.heightScaleMm);
        add(measured, batch.other, batch.touch, data.architecture.heightScaleMm);
    }
    generators.height->train();
    generators.friction->train();
    nlohmann::ordered_json figures{{"pairs", drawn}};
    for (const auto& [name, sum] : generated)
        figures[name] = {{"generated", shortened(sum / drawn)}, {"measured", shortened(measured[name] / drawn)}};
    return figures;
}

}  // namespace rendering::models
