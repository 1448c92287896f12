// A photograph to relief: the light's direction from the photograph itself, then one of two methods.
//   Linear         Pentland's linear method ("Linear shape from shading", 1990), regularised: one division per
//                  frequency. Exact for shallow relief of one reflectance under one distant light. The better one.
//   GaussianBumps  the paper's reference (Wang et al., "Electrostatic tactile rendering of image based on shape from
//                  shading", 2014) by its principle: the surface is a sum of Gaussian bumps, whose heights are fitted
//                  so that its Lambertian image is the photograph (Gauss-Newton). Slower; takes steep slopes.
// Slopes across the light leave no trace in a photograph. Whether bumps or dents are seen is settled as people do: light comes
// from above, unless the options say from below.
#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>

namespace rendering::signals {

/// Accurate works on every pixel; Fast on a quarter of them and enlarges the result.
enum class ShadingQuality { Fast, Accurate };
enum class ShadingMethod { Linear, GaussianBumps };

struct ShadingOptions {
    ShadingMethod method = ShadingMethod::Linear;
    ShadingQuality quality = ShadingQuality::Accurate;
    double highPassPx = 200;                  ///< longer waves are taken for uneven light, not relief
    double regularisation = 0.008;            ///< cycles per pixel along the light below which relief is not trusted
    std::optional<double> lightAzimuthDeg{};  ///< known direction; none: estimated
    bool lightFromBelow = false;              ///< of an estimated direction: turns bumps into dents
};

/// Azimuth: the direction in the image towards the light, degrees counter-clockwise from the right; 90:
/// from the top of the image.
struct Light {
    double azimuthDeg = 90;
    double coherence = 0;  ///< how clearly the photograph tells its axis, 0..1
};

/// The axis along which brightness changes most (the structure tensor of the high-passed photograph,
/// whose energy goes with the squared cosine of the angle to the light), a little drawn to light from above; its upper end, or
/// its left end where it is within 10 degrees of level: azimuth 10..190. Below a coherence of 0.02 it is 90. `photograph` as in
/// signals::grey.
Light estimateLight(const cv::Mat& photograph, double highPassPx = 200);

/// How much of the photograph's variation is one of colour: RMS of the high-passed differences between channels over that of the
/// brightness, 0 for a grey surface. Shading changes all channels alike: above coloursSpoilShading a pattern is dyed or
/// woven in colours, and what looks like relief may be dye.
double colourVariation(const cv::Mat& photograph, double highPassPx = 200);
inline constexpr double coloursSpoilShading = 0.35;

/// Height in pixels times the tangent of the light's slant (bumps: with a slant of 45 degrees), mean 0, CV_32FC1 of the
/// photograph's size. An even photograph gives an even relief. Throws badInput for an empty image.
cv::Mat shapeFromShading(const cv::Mat& photograph, const ShadingOptions& options = {});

}  // namespace rendering::signals
