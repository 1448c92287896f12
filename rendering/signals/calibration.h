// A GelSight sensor's calibration: how its light becomes slope and its slopes become settled height. Made by
// ball_presses.h or surface_calibration.h, saved as JSON.
#pragma once

#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "rendering/signals/frame_light.h"
#include "rendering/signals/slope_map.h"

namespace rendering::signals {

struct Calibration {
    LightMeasure light = LightMeasure::AgainstReference;
    int channels = 3;  ///< 3: a colour frame (R, G, B); else one a lamp
    SlopeMap map = LinearMap{};
    double mmPerPixel = 0;
    std::optional<double> highPassCutoffMm;  ///< longer waves are taken out; none: the slow surface stays
    double zeroPercentile = 2;               ///< percent of pixels that come to lie at or below 0; 0..50
    std::optional<SensorLook> sensor;        ///< of the untouched sensor it was made with
    bool operator==(const Calibration&) const = default;
};

/// {"schema":"vis2hap.calibration/1","kind":"linear"|"polynomial"|"network","light":"reference"|"own","channels":3,
///  "mm_per_pixel":..,"high_pass_cutoff_mm":..|null,"zero_percentile":..,"sensor":{..}, and of a linear map
///  "gradient_from_rgb":[[3],[3]],"offset":[2]; of a polynomial "degree","by_place","light_scale","coefficients"; of a
///  network "by_place","light_scale","sizes","weights"}. "light", "channels" and "sensor" may be missing. Throws
/// badInput naming the source and the field.
Calibration calibrationFromJson(std::string_view json, const std::string& where);
Calibration readCalibration(const std::filesystem::path& file);
std::string toJson(const Calibration& calibration);

}  // namespace rendering::signals
