// The quality of a calibration: its figures as JSON, and a sheet with the presses that have the largest errors.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "rendering/signals/tactile/ball_calibration.h"

namespace study::measuring {

struct QualityTrade {
    rendering::signals::MapQuality quality;
    rendering::signals::CalibrationScore score;
    double millisecondsAFrame = 0;  ///< light to slope, one thread
    double fitSeconds = 0;
};

std::string nameOf(rendering::signals::MapQuality quality);  ///< "fast", "balanced", "accurate"

/// The cross-validated score at one quality, with its cost.
QualityTrade tradeOf(const rendering::signals::BallPresses& presses, const rendering::signals::LocatedPresses& located,
                     rendering::signals::MapQuality quality);

/// {"normal_error_deg":..,"depth_error_mm":..,"peak_mm":..,"peak_range_mm":[..],"ball_peak_mm":..,"peak_over_gel_mm":..,"presses":[..]}
nlohmann::ordered_json jsonOf(const rendering::signals::CalibrationScore& score);

/// CV_8UC3, RGB. One labelled row for each of the dozen presses with the largest errors: frame with the circle found, height,
/// height of the ball, their difference.
cv::Mat pressSheet(const rendering::signals::BallPresses& presses, const rendering::signals::Calibration& calibration,
                   const rendering::signals::CalibrationScore& score);

}  // namespace study::measuring
