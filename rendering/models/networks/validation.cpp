#include "rendering/models/networks/validation.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <string>

#include "rendering/models/networks/batch_tensors.h"
#include "rendering/models/networks/contest.h"
#include "rendering/models/networks/finished_relief.h"

namespace rendering::models {

namespace {

using Sums = std::map<std::string, double>;

constexpr double decibelsPerNeper = 4.342944819032518;  ///< of power

/// `registeredHeight`: the measured map as it belongs to the candidate's.
void add(Sums& sums, const Touch& candidate, const Touch& measured, const TrainingData& data, const torch::Tensor& correlation)
{
    const auto count = static_cast<double>(measured.height.size(0));
    const auto put = [&](const char* name, const torch::Tensor& mean, double scale) {
        sums[name] += mean.item<double>() * scale * count;
    };
    const torch::Tensor deviations = candidate.height.flatten(1).std(1) / measured.height.flatten(1).std(1).clamp_min(1e-6);
    put("height_l1_mm", (candidate.height - measured.height).abs().mean(), data.architecture.heightScaleMm);
    put("height_ssim", ssim(candidate.height, measured.height, scalesOf(data).heightRange).mean(), 1);
    put("height_correlation", correlation.mean(), 1);
    put("height_radial_spectrum_db", radialDistance(candidate.height, measured.height), decibelsPerNeper);
    put("height_sq_ratio", deviations.clamp_min(1e-3).log().abs().mean(), 1);
    put("log_ratio_l1", (candidate.friction.logRatio - measured.friction.logRatio).abs().mean(), 1);
    put("mean_friction_relative_error",
        ((candidate.friction.mean - measured.friction.mean) / measured.friction.mean).abs().mean(), 1);
}

/// Inference for the time of its life.
class Inferring {
public:
    explicit Inferring(Generators& generators) : m_generators(generators) { train(false); }
    ~Inferring() { train(true); }
    Inferring(const Inferring&) = delete;
    Inferring& operator=(const Inferring&) = delete;

private:
    void train(bool on)
    {
        m_generators.height->train(on);
        m_generators.friction->train(on);
    }
    Generators& m_generators;
    torch::NoGradGuard m_still;
};

/// [1, H, W] in units of the networks.
cv::Mat inMillimetres(const torch::Tensor& map, double heightScaleMm)
{
    const torch::Tensor flat = map.contiguous();
    return cv::Mat(static_cast<int>(flat.size(1)), static_cast<int>(flat.size(2)), CV_32F, flat.data_ptr<float>()) *
           heightScaleMm;
}

/// [3, H, W] in 0..1.
cv::Mat asPicture(const torch::Tensor& photograph)
{
    const torch::Tensor bytes = (photograph.permute({1, 2, 0}) * 255).round().clamp(0, 255).to(torch::kByte).contiguous();
    return cv::Mat(static_cast<int>(bytes.size(0)), static_cast<int>(bytes.size(1)), CV_8UC3, bytes.data_ptr<std::uint8_t>())
        .clone();
}

/// Enough places to compare by.
double shortened(double value) { return std::round(value * 1e6) / 1e6; }

}  // namespace

nlohmann::ordered_json validationFigures(const TrainingData& data, Generators& generators, const LossWeights& weights, int pairs,
                                         protocols::Random& random)
{
    const Inferring inferring(generators);
    Sums generated, measured;
    double distances = 0;
    BatchWish wish;
    wish.size = 4;
    wish.augment = false;
    wish.margin = registrationMarginPx;
    int drawn = 0;
    for (; drawn < pairs; drawn += wish.size) {
        const TensorBatch batch = tensorsOf(drawBatch(data, data.validation, wish, random));
        Touch guess{generators.height->forward(batch.photograph), generators.height->rings(batch.photograph),
                    generators.friction->forward(batch.photograph)};
        distances += distance(guess, batch.measuredFor(guess.height), weights, scalesOf(data)).item<double>() * wish.size;
        guess.height = finishedRelief(guess.height, guess.rings, data.architecture);
        const auto compare = [&](Sums& sums, const Touch& touch) {
            const Registered fitted = registered(touch.height, batch.heights);
            add(sums, touch, {fitted.maps, batch.rings, batch.friction}, data, fitted.correlation);
        };
        compare(generated, guess);
        compare(measured, batch.other);
    }
    nlohmann::ordered_json figures{{"pairs", drawn}, {"distance", {{"generated", shortened(distances / drawn)}}}};
    for (const auto& [name, sum] : generated) {
        const bool ratio = name == "height_sq_ratio";
        const auto figure = [&](double total) { return shortened(ratio ? std::exp(total / drawn) : total / drawn); };
        figures[name] = {{"generated", figure(sum)}, {"measured", figure(measured[name])}};
    }
    return figures;
}

std::vector<SampleRow> sampleRows(const TrainingData& data, Generators& generators, std::uint64_t seed)
{
    const Inferring inferring(generators);
    constexpr std::size_t most = 6;
    std::vector<FabricSamples> shown;
    for (std::size_t i = 0; i < std::min(most, data.validation.size()); ++i)
        shown.push_back(data.validation[i * data.validation.size() / std::min(most, data.validation.size())]);
    std::vector<SampleRow> rows;
    protocols::Random random = protocols::Random::stream(seed, "samples");
    BatchWish wish;
    wish.size = 1;
    wish.augment = false;
    wish.margin = registrationMarginPx;
    for (const FabricSamples& fabric : shown) {
        const TensorBatch batch = tensorsOf(drawBatch(data, {fabric}, wish, random));
        const torch::Tensor height = finishedRelief(generators.height->forward(batch.photograph),
                                                    generators.height->rings(batch.photograph), data.architecture);
        const double scale = data.architecture.heightScaleMm;
        rows.push_back({fabric.fabric.value, asPicture(batch.photograph[0]),
                        inMillimetres(registered(height, batch.heights).maps[0], scale), inMillimetres(height[0], scale)});
    }
    return rows;
}

}  // namespace rendering::models
