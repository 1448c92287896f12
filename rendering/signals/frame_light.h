// A frame as light alone, before it is read as slope: what differs from the untouched sensor, or, where no
// frame of the untouched sensor exists, from the frame's own smooth illumination.
#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

namespace rendering::signals {

enum class LightMeasure {
    AgainstReference,  ///< (frame - reference) / full scale
    AgainstOwnLight,   ///< frame / its illumination - 1: a cubic surface through most of ln(frame), a channel at a time
};

/// CV_32FC(n). `frame`, and `reference` where it is asked for: 8 or 16 bits, n channels, one size. Throws badInput where
/// they differ in size or kind.
cv::Mat lightOf(const cv::Mat& frame, const cv::Mat& reference, LightMeasure measure);

/// ln of the cubic surface that most pixels of one channel lie about (iteratively reweighted least squares, Cauchy
/// weights): relief, dust and saturated places do not pull it. CV_32FC1.
cv::Mat logIllumination(const cv::Mat& channel);

/// One-channel frames of one lamp each as the channels of one frame. Throws badInput for frames of different size or kind.
cv::Mat oneFrame(const std::vector<cv::Mat>& lamps);

/// The colours of the untouched sensor, coarsely, so that another sensor or swapped channels are noticed.
struct SensorLook {
    static constexpr int columns = 4, rows = 3;
    int width = 0, height = 0;
    std::vector<double> colours;  ///< mean of each field, row by row, each channel; 0..1
    bool operator==(const SensorLook&) const = default;
};

SensorLook lookOf(const cv::Mat& reference);

/// Why two looks are not those of one sensor, as a sentence's end ("its red and blue are swapped"); none: they are. Three
/// channels only; others are compared in their order alone.
std::optional<std::string> differenceOf(const SensorLook& known, const SensorLook& found);

}  // namespace rendering::signals
