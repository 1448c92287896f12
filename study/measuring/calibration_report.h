// What a calibration's maker wants to see: the numbers as JSON, and a sheet with the presses that were read worst.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "rendering/signals/ball_presses.h"

namespace study::measuring {

struct QualityTrade {
    rendering::signals::MapQuality quality;
    rendering::signals::CalibrationScore score;
    double millisecondsAFrame = 0;  ///< light to slope, one thread
    double fitSeconds = 0;
};

std::string nameOf(rendering::signals::MapQuality quality);  ///< "fast", "balanced", "accurate"

/// Cross-validated, at one quality, with its cost.
QualityTrade tradeOf(const rendering::signals::BallPresses& presses, const rendering::signals::LocatedPresses& located,
                     rendering::signals::MapQuality quality);

/// {"normal_error_deg":..,"depth_error_mm":..,"peak_mm":..,"peak_range_mm":[..],"ball_peak_mm":..,"peak_over_gel_mm":..,"presses":[..]}
nlohmann::ordered_json jsonOf(const rendering::signals::CalibrationScore& score);

/// One row a press, the worst dozen first: frame with the circle found, height, the ball's height, their difference; labelled.
/// CV_8UC3, RGB.
cv::Mat pressSheet(const rendering::signals::BallPresses& presses, const rendering::signals::Calibration& calibration,
                   const rendering::signals::CalibrationScore& score);

}  // namespace study::measuring
