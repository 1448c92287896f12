// The mean friction that a photograph's texture alone lets expect. A network knows the fabrics it was
// trained on and is at a loss with others; how strong the coarse and fine waves of a weave are tells
// roughly how it rubs, whichever fabric it is. A ridge regression over fabrics says it, and speaks where
// a photograph is unfamiliar (familiarity.h). No torch here.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <opencv2/core/mat.hpp>
#include <span>
#include <vector>

namespace rendering::models {

/// Of the radial spectrum of a photograph's brightness over its mean (rings of `side` px, ring_spectrum.h): the
/// first cosine coefficients of its logarithm, as speech is described by those of its own. Finite for any CV_8UC3.
inline constexpr int textureCoefficientCount = 5;
std::vector<double> textureCoefficients(const cv::Mat& rgb, int side);

/// A photograph trained on, and the logarithm of its fabric's mean coefficient of friction.
struct KnownTexture {
    std::vector<double> coefficients;
    double logFriction = 0;
    double weight = 1;  ///< of this one; one over the photographs of its fabric makes fabrics equal
};

struct FrictionPrior {
    std::vector<double> mean, deviation;  ///< of the coefficients in training
    std::vector<double> slope;            ///< of the logarithm of friction, per deviation
    double logFriction = 0;               ///< at the mean
    double lowest = 0, highest = 0;       ///< logarithms of friction in training; no answer lies beyond
};

/// Throws badInput for no texture.
FrictionPrior fitFrictionPrior(std::span<const KnownTexture> textures);

/// How far a regression carries, 1 to 0: wholly up to four times the usual distance to known photographs, from six times on
/// not at all.
double reachOfRegression(double distance, double usualDistance);

/// Coefficient of friction; with less `reach` nearer to the typical one of all fabrics trained on.
double expectedFriction(const FrictionPrior& prior, const std::vector<double>& coefficients, double reach = 1);

nlohmann::ordered_json frictionPriorJson(const FrictionPrior& prior);
/// Throws badInput for numbers that cannot be.
FrictionPrior frictionPriorFrom(const nlohmann::ordered_json& json);

}  // namespace rendering::models
