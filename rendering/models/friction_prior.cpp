#include "rendering/models/friction_prior.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <numeric>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "protocols/files/errors.h"
#include "rendering/models/ring_spectrum.h"

namespace rendering::models {

namespace {

/// Share of the weights that is added to each sum of squares, because the coefficients of a few fabrics are correlated.
constexpr double ridge = 0.01;
constexpr double leastCoefficientDeviation = 0.02;
constexpr double mostDeviations = 2.5;  ///< limit of a standardised coefficient; training photographs lie within
constexpr double leastBrightness = 5;   ///< grey levels; the noise of the camera dominates below
constexpr double noisePower = 1e-4;     ///< relative to the mean brightness; the rounding of a dim photograph to 8 bits

constexpr auto coefficientCount = static_cast<std::size_t>(textureCoefficientCount);

double totalWeight(std::span<const KnownTexture> textures)
{
    return std::accumulate(textures.begin(), textures.end(), 0.0,
                           [](double sum, const KnownTexture& texture) { return sum + texture.weight; });
}

void fitScale(FrictionPrior& prior, std::span<const KnownTexture> textures)
{
    const double all = totalWeight(textures);
    prior.mean.assign(coefficientCount, 0);
    prior.deviation.assign(coefficientCount, 0);
    for (const KnownTexture& texture : textures)
        for (std::size_t i = 0; i < coefficientCount; ++i) prior.mean[i] += texture.weight / all * texture.coefficients[i];
    for (const KnownTexture& texture : textures)
        for (std::size_t i = 0; i < coefficientCount; ++i)
            prior.deviation[i] += texture.weight / all * std::pow(texture.coefficients[i] - prior.mean[i], 2);
    for (double& deviation : prior.deviation) deviation = std::max(leastCoefficientDeviation, std::sqrt(deviation));
}

std::vector<double> standardised(const FrictionPrior& prior, const std::vector<double>& coefficients)
{
    std::vector<double> result;
    for (std::size_t i = 0; i < coefficientCount; ++i) result.push_back((coefficients[i] - prior.mean[i]) / prior.deviation[i]);
    return result;
}

/// Solves (X'WX + ridge) slope = X'Wy, where the weights sum to 1.
void fitSlope(FrictionPrior& prior, std::span<const KnownTexture> textures)
{
    const double all = totalWeight(textures);
    cv::Mat left = cv::Mat::eye(textureCoefficientCount, textureCoefficientCount, CV_64F) * ridge;
    cv::Mat right = cv::Mat::zeros(textureCoefficientCount, 1, CV_64F), slope;
    for (const KnownTexture& texture : textures) {
        const cv::Mat row(standardised(prior, texture.coefficients), true);
        left += row * row.t() * (texture.weight / all);
        right += row * ((texture.logFriction - prior.logFriction) * texture.weight / all);
    }
    cv::solve(left, right, slope, cv::DECOMP_CHOLESKY);
    prior.slope.assign(slope.begin<double>(), slope.end<double>());
}

bool sensible(const FrictionPrior& prior)
{
    const auto sound = [](const std::vector<double>& numbers) {
        return numbers.size() == coefficientCount &&
               std::all_of(numbers.begin(), numbers.end(), [](double number) { return std::isfinite(number); });
    };
    return sound(prior.mean) && sound(prior.deviation) && sound(prior.slope) &&
           std::all_of(prior.deviation.begin(), prior.deviation.end(), [](double deviation) { return deviation > 0; }) &&
           std::isfinite(prior.logFriction) && prior.lowest >= -20 && prior.highest <= 20 && prior.lowest <= prior.highest;
}

}  // namespace

std::vector<double> textureCoefficients(const cv::Mat& rgb, int side)
{
    cv::Mat grey;
    cv::cvtColor(rgb, grey, cv::COLOR_RGB2GRAY);
    grey.convertTo(grey, CV_32F);
    const std::vector<float> rings = ringPowers(grey / std::max(leastBrightness, cv::mean(grey)[0]), side);
    std::vector<double> coefficients;
    for (int k = 0; k < textureCoefficientCount; ++k) {
        double sum = 0;
        for (int ring = 0; ring < ringCount; ++ring)
            sum += std::log(std::exp(static_cast<double>(rings[static_cast<std::size_t>(ring)])) + noisePower) *
                   std::cos(std::numbers::pi * k * (ring + 0.5) / ringCount);
        coefficients.push_back(sum / ringCount);
    }
    return coefficients;
}

FrictionPrior fitFrictionPrior(std::span<const KnownTexture> textures)
{
    if (textures.empty())
        throw protocols::badInput(
            {"there are no training photographs", "friction by texture", "at least one", "add photographs"});
    FrictionPrior prior;
    fitScale(prior, textures);
    prior.lowest = prior.highest = textures.front().logFriction;
    for (const KnownTexture& texture : textures) {
        prior.logFriction += texture.weight / totalWeight(textures) * texture.logFriction;
        prior.lowest = std::min(prior.lowest, texture.logFriction);
        prior.highest = std::max(prior.highest, texture.logFriction);
    }
    fitSlope(prior, textures);
    return prior;
}

double regressionWeight(double distance, double usualDistance) { return std::clamp(3 - distance / usualDistance / 2, 0.0, 1.0); }

double expectedFriction(const FrictionPrior& prior, const std::vector<double>& coefficients, double weight)
{
    double logFriction = prior.logFriction;
    const std::vector<double> point = standardised(prior, coefficients);
    for (std::size_t i = 0; i < coefficientCount; ++i)
        logFriction += weight * prior.slope[i] * std::clamp(point[i], -mostDeviations, mostDeviations);
    return std::exp(std::clamp(logFriction, prior.lowest, prior.highest));
}

nlohmann::ordered_json frictionPriorJson(const FrictionPrior& prior)
{
    return {{"coefficients_mean", prior.mean},
            {"coefficients_sd", prior.deviation},
            {"slope", prior.slope},
            {"log_friction", prior.logFriction},
            {"lowest", prior.lowest},
            {"highest", prior.highest}};
}

FrictionPrior frictionPriorFrom(const nlohmann::ordered_json& json)
{
    FrictionPrior prior;
    prior.mean = json.at("coefficients_mean").get<std::vector<double>>();
    prior.deviation = json.at("coefficients_sd").get<std::vector<double>>();
    prior.slope = json.at("slope").get<std::vector<double>>();
    prior.logFriction = json.at("log_friction").get<double>();
    prior.lowest = json.at("lowest").get<double>();
    prior.highest = json.at("highest").get<double>();
    if (!sensible(prior))
        throw protocols::badInput({"the numbers on friction by texture are impossible", "friction_by_texture",
                                   std::to_string(textureCoefficientCount) + " finite coefficients",
                                   "copy the card again, or train again"});
    return prior;
}

}  // namespace rendering::models
