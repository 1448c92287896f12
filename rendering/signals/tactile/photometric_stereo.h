// A GelSight frame to height. The light against the untouched sensor gives slopes through the calibration, and the
// integrated slopes give height. The low-frequency surface is removed, and a low percentile becomes 0.
#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>

#include "rendering/signals/surface_integration.h"
#include "rendering/signals/tactile/calibration.h"

namespace rendering::signals {

/// CV_32FC1 each. `frame` and `reference` as lightOf() takes them (R, G, B order). Throws badInput where they differ in size
/// or type, or do not have the channels of the calibration.
Slopes slopesFromFrame(const cv::Mat& frame, const cv::Mat& reference, const Calibration& calibration);

/// Height above the low percentile of the calibration, mm, >= 0, CV_32FC1 of the size of the frame. For a frame of full
/// contact, such as a fabric pressed flat.
cv::Mat heightFromFrame(const cv::Mat& frame, const cv::Mat& reference, const Calibration& calibration,
                        IntegrationQuality quality = IntegrationQuality::Full);

/// Removes waves longer than `highPassCutoffMm`, then shifts the height so that its `zeroPercentile` becomes 0, mm, >= 0. Throws
/// badInput for heights that are not finite.
cv::Mat zeroedRelief(const cv::Mat& heightMm, const Pitch& pitch, std::optional<double> highPassCutoffMm, double zeroPercentile);

/// True where most of the frame is untouched: over 60 % of it, the light is weaker than a quarter of the strongest light.
bool hasOutside(const cv::Mat& light);

/// Contact between object and gel.
struct Contact {
    cv::Mat places;           ///< CV_8UC1, 255 in contact
    double levelErrorMm = 0;  ///< half the range of heights at which the edge is nearly as clear
};

/// Around an object the gel returns to its rest surface, and it is steepest at the edge of contact. The edge is the contour of
/// `gelHeightMm` (levelled, rest surface at 0) with the largest mean change of light (lightOf()). Slopes would place it too
/// far out: the map from light to slope extrapolates beyond the steepest place of its calibration.
Contact contactOf(const cv::Mat& gelHeightMm, const cv::Mat& light);

/// Height of the object above the edge of its contact, mm, >= 0, CV_32FC1. 0 outside the contact, where the gel does not
/// follow the object.
cv::Mat heightInContact(const Slopes& slopes, const cv::Mat& contact, const Pitch& pitch,
                        IntegrationQuality quality = IntegrationQuality::Full);

/// Slopes from a normal map, which stores (n + 1) / 2 in R, G, B: dh/dx = -nx / nz, dh/dy = ny / nz. The y of the normal
/// points up the image, as is usual in graphics. Normals that face away (nz <= 0.02) give NaN. CV_32FC1 each.
/// `image`: CV_8UC3 or CV_16UC3. Throws badInput for another type.
Slopes slopesFromNormals(const cv::Mat& image);

}  // namespace rendering::signals
