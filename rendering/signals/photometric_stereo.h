// A GelSight frame to height: light against the untouched sensor -> slopes by the sensor's
// calibration -> integration -> removal of the slow surface -> the lowest places at 0.
#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>

#include "rendering/signals/calibration.h"
#include "rendering/signals/surface_integration.h"

namespace rendering::signals {

/// CV_32FC1 each. `frame` and `reference` as the calibration measures light (R, G, B order). Throws badInput where they
/// differ in size or kind, or have other channels than the calibration.
Slopes slopesFromFrame(const cv::Mat& frame, const cv::Mat& reference, const Calibration& calibration);

/// Height above the stated low percentile, mm, >= 0, CV_32FC1 of the frame's size: a frame of full contact, as fabric pressed
/// flat gives.
cv::Mat heightFromFrame(const cv::Mat& frame, const cv::Mat& reference, const Calibration& calibration,
                        IntegrationQuality quality = IntegrationQuality::Full);

/// The last two steps alone, so that a known surface can be brought into the same form.
cv::Mat settled(const cv::Mat& heightMm, const Pitch& pitch, std::optional<double> highPassCutoffMm, double zeroPercentile);

/// Whether most of the frame is untouched: 60 % of it shows less than a quarter of the strongest light.
bool hasOutside(const cv::Mat& light);

/// Where the object touches the gel, CV_8UC1. Around an object the gel bridges to its rest surface; the gel is steepest at the
/// edge of contact. The edge is that contour of `gelHeightMm` (levelled, rest surface at 0) along which the slope
/// is largest.
cv::Mat contactOf(const cv::Mat& gelHeightMm, const Slopes& slopes);

/// Height of the object above the edge of its contact, mm, >= 0, CV_32FC1; outside contact, where the gel's shape is not the
/// object's, 0.
cv::Mat heightInContact(const Slopes& slopes, const cv::Mat& contact, const Pitch& pitch,
                        IntegrationQuality quality = IntegrationQuality::Full);

/// Normals as an image stores them, (n + 1) / 2 in R, G, B, as slopes dh/dx = -nx / nz, dh/dy = ny / nz: y of the
/// normal points up the image, as graphics stores it. Facing away (nz <= 0.02) is missing: NaN. CV_32FC1 each.
/// `image`: CV_8UC3 or CV_16UC3. Throws badInput for another kind.
Slopes slopesFromNormals(const cv::Mat& image);

}  // namespace rendering::signals
