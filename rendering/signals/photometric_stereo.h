// A GelSight frame to height: colour change against the untouched sensor -> slopes by the sensor's
// calibration -> integration -> removal of the slow surface -> the lowest places at 0.
#pragma once

#include <array>
#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "rendering/signals/surface_integration.h"

namespace rendering::signals {

/// A linear sensor: with d = (frame - reference) / 255 as (R, G, B), the slopes are
/// [dh/dx, dh/dy] = gradientFromRgb * d + offset, in mm/mm; h grows towards the sensor.
struct Calibration {
    std::array<std::array<double, 3>, 2> gradientFromRgb{};
    std::array<double, 2> offset{};
    double mmPerPixel = 0;
    std::optional<double> highPassCutoffMm;  ///< longer waves are taken out; none: the slow surface stays
    double zeroPercentile = 2;               ///< percent of pixels that come to lie at or below 0; 0..50
    bool operator==(const Calibration&) const = default;
};

/// {"schema":"vis2hap.calibration/1","kind":"linear","gradient_from_rgb":[[3],[3]],"offset":[2],
///  "mm_per_pixel":..,"high_pass_cutoff_mm":..|null,"zero_percentile":..}. Throws badInput naming the
/// source and the field.
Calibration calibrationFromJson(std::string_view json, const std::string& where);
Calibration readCalibration(const std::filesystem::path& file);
std::string toJson(const Calibration& calibration);

/// CV_32FC1 each. `frame` and `reference`: CV_8UC3 in R, G, B order. Throws badInput where they differ
/// in size or kind.
Slopes slopesFromFrame(const cv::Mat& frame, const cv::Mat& reference, const Calibration& calibration);

/// Height above the stated low percentile, mm, >= 0, CV_32FC1 of the frame's size.
cv::Mat heightFromFrame(const cv::Mat& frame, const cv::Mat& reference, const Calibration& calibration,
                        IntegrationQuality quality = IntegrationQuality::Full);

/// The last two steps alone, so that a known surface can be brought into the same form.
cv::Mat settled(const cv::Mat& heightMm, const Pitch& pitch, std::optional<double> highPassCutoffMm, double zeroPercentile);

}  // namespace rendering::signals
