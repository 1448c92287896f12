// Mean friction that is expected from the texture of a photograph alone. A network predicts poorly for fabrics that it
// was not trained on. The strength of the coarse and fine waves of a weave predicts roughly how it rubs, for any fabric.
// A ridge regression over the training fabrics uses this; it replaces the network's mean for unfamiliar photographs
// (familiarity.h). No torch here.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <opencv2/core/mat.hpp>
#include <span>
#include <vector>

namespace rendering::models {

/// The first cepstral coefficients of a photograph: cosine coefficients of the logarithm of its radial power spectrum
/// (ring_spectrum.h, rings of `side` px). The brightness is divided by its mean first. Finite for any CV_8UC3.
inline constexpr int textureCoefficientCount = 5;
std::vector<double> textureCoefficients(const cv::Mat& rgb, int side);

/// Texture of a training photograph, and the logarithm of the mean friction of its fabric.
struct KnownTexture {
    std::vector<double> coefficients;
    double logFriction = 0;
    double weight = 1;  ///< one over the number of photographs of the fabric gives fabrics equal weight
};

struct FrictionPrior {
    std::vector<double> mean, deviation;  ///< each coefficient's mean and standard deviation over the training photographs
    std::vector<double> slope;            ///< change of the logarithm of friction per standard deviation
    double logFriction = 0;               ///< logarithm of friction at the mean
    double lowest = 0, highest = 0;       ///< range of the logarithm of friction in training; limits every prediction
};

/// Fits the regression. Throws badInput for no texture.
FrictionPrior fitFrictionPrior(std::span<const KnownTexture> textures);

/// Weight of the regression: 1 up to four times the usual distance to known photographs. From there it falls linearly to 0
/// at six times.
double regressionWeight(double distance, double usualDistance);

/// Coefficient of friction. A smaller `weight` moves it towards the typical coefficient of the training fabrics.
double expectedFriction(const FrictionPrior& prior, const std::vector<double>& coefficients, double weight = 1);

nlohmann::ordered_json frictionPriorJson(const FrictionPrior& prior);
/// Throws badInput for impossible numbers.
FrictionPrior frictionPriorFrom(const nlohmann::ordered_json& json);

}  // namespace rendering::models
