// How the frame of an untouched tactile sensor looks, and whether frames are of the sensor that a calibration states. The check
// of a data set and the computation of heights compare in this one way; a header alone, so that both rooms may use it.
#pragma once

#include <cmath>
#include <cstddef>
#include <numeric>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <string>
#include <vector>

namespace rendering {

/// Coarse colours of the untouched sensor, which reveal another sensor or swapped channels.
struct SensorAppearance {
    static constexpr int columns = 4, rows = 3;
    int width = 0, height = 0;
    std::vector<double> colours;  ///< mean of each field, row by row, channel by channel; 0 to 1
    bool operator==(const SensorAppearance&) const = default;
};

/// `reference`: frame of the untouched sensor, 8 or 16 bits.
inline SensorAppearance appearanceOf(const cv::Mat& reference)
{
    cv::Mat coarse;
    reference.convertTo(coarse, CV_32F, 1.0 / (reference.depth() == CV_16U ? 65535 : 255));
    cv::resize(coarse, coarse, {SensorAppearance::columns, SensorAppearance::rows}, 0, 0, cv::INTER_AREA);
    const cv::Mat flat = coarse.reshape(1, 1);
    return {reference.cols, reference.rows, std::vector<double>(flat.begin<float>(), flat.end<float>())};
}

/// Mean differences of colour, 0 to 1, above which two frames are of different sensors.
struct AppearanceLimits {
    double swapped;  ///< smaller differences do not show an order of channels
    double other;
};

/// Two frames of one untouched sensor differ by 0.01.
inline constexpr AppearanceLimits untouchedFrames{0.02, 0.06};

/// Reason why two appearances belong to different sensors, as the end of a sentence ("its red and blue are swapped").
/// Returns nullopt where they match. Swapped channels are only recognised among three.
inline std::optional<std::string> differenceOf(const SensorAppearance& known, const SensorAppearance& found,
                                               const AppearanceLimits& limits = untouchedFrames)
{
    if (known.width != found.width || known.height != found.height)
        return "it has " + std::to_string(found.width) + " x " + std::to_string(found.height) + " pixels, but the sensor has " +
               std::to_string(known.width) + " x " + std::to_string(known.height);
    if (known.colours.size() != found.colours.size()) return "its number of channels differs";
    std::vector<std::size_t> order(known.colours.size() / (SensorAppearance::columns * SensorAppearance::rows));
    std::iota(order.begin(), order.end(), 0);
    const auto meanDifference = [&](const std::vector<std::size_t>& channels) {
        double sum = 0;
        for (std::size_t i = 0; i < known.colours.size(); ++i)
            sum +=
                std::abs(known.colours[i] - found.colours[i / channels.size() * channels.size() + channels[i % channels.size()]]);
        return sum / static_cast<double>(known.colours.size());
    };
    const double asItIs = meanDifference(order);
    if (order.size() == 3 && asItIs > limits.swapped && meanDifference({2, 1, 0}) < 0.5 * asItIs)
        return "its red and blue are swapped";
    if (asItIs > limits.other)
        return "its colours differ by " + std::to_string(std::lround(100 * asItIs)) +
               " % of full scale, so it shows another sensor or other light";
    return std::nullopt;
}

/// Whether the pitch of a calibration is that of the frames, within 1 %: roundings are, another size or binning is not.
inline bool isSamePitch(double calibrationMm, double framesMm) { return std::abs(calibrationMm / framesMm - 1) <= 0.01; }

}  // namespace rendering
