// Calibration of a GelSight sensor: the map from light to slope, and the conversion of slopes to height. Made by
// ball_calibration.h or surface_calibration.h, saved as JSON.
#pragma once

#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "rendering/signals/tactile/frame_light.h"
#include "rendering/signals/tactile/slope_map.h"

namespace rendering::fabrics {
struct Dataset;
}

namespace rendering::signals {

struct Calibration {
    LightMeasure light = LightMeasure::AgainstReference;
    int channels = 3;  ///< 3 for a colour frame (R, G, B), else one for each lamp
    SlopeMap map = LinearMap{};
    double mmPerPixel = 0;
    std::optional<double> highPassCutoffMm;  ///< removes longer waves; nullopt keeps the low-frequency surface
    double zeroPercentile = 2;               ///< percent of pixels at or below height 0; 0 to 50
    std::optional<SensorAppearance> sensor;  ///< appearance of the untouched sensor
    bool operator==(const Calibration&) const = default;
};

/// Reads {"schema":"vis2hap.calibration/1","kind":"linear"|"polynomial"|"network","light":"reference"|"own","channels":3,
///  "mm_per_pixel":..,"high_pass_cutoff_mm":..|null,"zero_percentile":..,"sensor":{..}} with the fields of its kind:
///  linear "gradient_from_rgb":[[3],[3]],"offset":[2]; polynomial "degree","by_place","light_scale","coefficients";
///  network "by_place","light_scale","sizes","weights". "light", "channels" and "sensor" are optional. Throws badInput
/// naming the source and the field.
Calibration calibrationFromJson(std::string_view json, const std::string& where);
Calibration readCalibration(const std::filesystem::path& file);

/// The calibration that a data set names for its tactile frames. `reference`: its frame of the untouched sensor. Throws badInput
/// as readCalibration(), where that frame shows another sensor than the calibration states, and where dataset.json states another
/// pitch.
Calibration calibrationOf(const fabrics::Dataset& dataset, const cv::Mat& reference);
std::string toJson(const Calibration& calibration);

}  // namespace rendering::signals
