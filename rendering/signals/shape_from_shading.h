// A photograph to relief: the light's direction from the photograph itself, then Pentland's linear
// method, regularised ("Linear shape from shading", 1990). Exact for shallow relief of one
// reflectance under one distant light; slopes across the light leave no trace in the photograph and
// come out as 0. Whether bumps or dents are seen is settled as people do: light comes from above.
#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>

namespace rendering::signals {

/// Accurate works on every pixel; Fast on a quarter of them and enlarges the result.
enum class ShadingQuality { Fast, Accurate };

struct ShadingOptions {
    ShadingQuality quality = ShadingQuality::Accurate;
    double highPassPx = 200;                  ///< longer waves are taken for uneven light, not relief
    double regularisation = 0.008;           ///< cycles per pixel along the light below which relief is not trusted
    std::optional<double> lightAzimuthDeg{};  ///< known direction; none: estimated
};

/// Azimuth: the direction in the image towards the light, degrees counter-clockwise from the right; 90:
/// from the top of the image.
struct Light {
    double azimuthDeg = 90;
    double coherence = 0;  ///< how clearly the photograph tells its axis, 0..1
};

/// The axis along which brightness changes most (the structure tensor of the high-passed photograph,
/// whose energy goes with the squared cosine of the angle to the light); its upper end, or its left end
/// where it is within 10 degrees of level: azimuth 10..190. Below a coherence of 0.02 it is 90.
/// `photograph` as in signals::grey.
Light estimateLight(const cv::Mat& photograph, double highPassPx = 200);

/// Height in pixels times the sine of the light's slant, mean 0, CV_32FC1 of the photograph's size.
/// An even photograph gives an even relief. Throws badInput for an empty image.
cv::Mat shapeFromShading(const cv::Mat& photograph, const ShadingOptions& options = {});

}  // namespace rendering::signals
