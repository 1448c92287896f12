// Light of a tactile frame, before it is converted to slope. It is the difference from a frame of the untouched sensor.
// Where no such frame exists, it is the difference from the frame's own smooth illumination.
#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "rendering/images/sensor_appearance.h"

namespace rendering::signals {

enum class LightMeasure {
    AgainstReference,  ///< (frame - reference) / full scale
    AgainstOwnLight,   ///< frame / illumination - 1, channel by channel; the illumination is a cubic surface in ln(frame)
};

/// CV_32FC(n). `frame`, and `reference` where `measure` needs it: 8 or 16 bits, n channels, one size. Throws badInput where
/// size or type differ.
cv::Mat lightOf(const cv::Mat& frame, const cv::Mat& reference, LightMeasure measure);

/// Logarithm of the illumination: the cubic surface through most pixels of one channel, CV_32FC1. Iteratively reweighted
/// least squares with Cauchy weights, so that relief, dust and saturated pixels have little influence.
cv::Mat logIllumination(const cv::Mat& channel);

/// Merges frames of one channel, one for each lamp. Throws badInput where size or depth differ.
cv::Mat oneFrame(const std::vector<cv::Mat>& lamps);

using rendering::appearanceOf;
using rendering::differenceOf;
using rendering::SensorAppearance;

/// Reason why a frame cannot be of the sensor with this background, in the same form; an object in the frame is allowed for.
/// Returns nullopt where its light may be the sensor's.
std::optional<std::string> foreignLight(const cv::Mat& background, const cv::Mat& frame);

}  // namespace rendering::signals
