// Relief from a photograph: the direction of the light is estimated, then one of two methods is used.
//   Linear         Pentland's linear method ("Linear shape from shading", 1990), regularised: one division for each
//                  frequency. Exact for shallow relief of one reflectance under one distant light. The better one.
//   GaussianBumps  the principle of the paper's reference (Wang et al., "Electrostatic tactile rendering of image based
//                  on shape from shading", 2014). The surface is a sum of Gaussian bumps. Their heights are fitted by
//                  Gauss-Newton so that its Lambertian image equals the photograph. Slower; handles steep slopes.
// A photograph contains no information on slopes across the light, and bumps under light from above look like dents under
// light from below. Like human vision, the methods assume light from above, unless the options state light from below.
#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>

namespace rendering::signals {

/// Accurate uses every pixel; Fast uses a quarter of them and enlarges the result.
enum class ShadingQuality { Fast, Accurate };
enum class ShadingMethod { Linear, GaussianBumps };

struct ShadingOptions {
    ShadingMethod method = ShadingMethod::Linear;
    ShadingQuality quality = ShadingQuality::Accurate;
    double highPassPx = 200;                  ///< longer waves count as uneven light, not as relief
    double regularisation = 0.008;            ///< cycles per pixel along the light; lower frequencies are damped
    std::optional<double> lightAzimuthDeg{};  ///< known direction; nullopt: estimated
    bool lightFromBelow = false;              ///< reverses an estimated direction, which turns bumps into dents
};

/// Azimuth: direction in the image towards the light, degrees counter-clockwise from the right; 90 is the top of the image.
struct Light {
    double azimuthDeg = 90;
    double coherence = 0;  ///< clarity of the light's axis in the photograph, 0 to 1
};

/// Estimates the axis along which brightness changes most, from the structure tensor of the high-passed photograph. Its
/// energy is proportional to the squared cosine of the angle to the light; a small prior favours light from above. Of the
/// two ends of the axis the upper one is returned or, within 10 degrees of horizontal, the left one: azimuth 10 to 190.
/// Below a coherence of 0.02 the azimuth is 90. Photographs of more than 4.2 megapixels are judged by 16 tiles of 512 pixels,
/// evenly spread. `photograph`: as signals::grey() takes it.
Light estimateLight(const cv::Mat& photograph, double highPassPx = 200);

/// RMS of the high-passed differences between the channels over the RMS of the brightness; 0 for a grey surface. Shading
/// changes all channels equally. Above coloursSpoilShading the pattern is dyed or woven in colours, and apparent relief may
/// be dye.
double colourVariation(const cv::Mat& photograph, double highPassPx = 200);
inline constexpr double coloursSpoilShading = 0.35;

/// Height in pixels times the tangent of the light's slant (GaussianBumps: slant of 45 degrees), mean 0, CV_32FC1 of the
/// photograph's size. A uniform photograph gives a flat relief. Throws badInput for an empty image.
cv::Mat shapeFromShading(const cv::Mat& photograph, const ShadingOptions& options = {});

struct ReliefPart {
    cv::Mat height;              ///< CV_32FC1 of the part's size
    double varianceLeftOut = 0;  ///< share of the photograph's relief outside the part, estimated from the shading; 0 to 1
};

/// The part of shapeFromShading()'s relief that lies in `part`, from the part and 512 pixels around it. The method is Linear and
/// Accurate; `light` is estimateLight() of the whole photograph. Its difference from the whole relief, whose mean is 0, is far
/// below a grey level of the display.
ReliefPart reliefOfPart(const cv::Mat& photograph, const cv::Rect& part, const Light& light, const ShadingOptions& options = {});

}  // namespace rendering::signals
