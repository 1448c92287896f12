// The strongest wave of a picture: the period and direction by which a weave is recognised.
#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>

namespace rendering::signals {

struct DominantWave {
    double periodPx = 0;
    double directionDeg = 0;  ///< in which the wave runs, from the picture's rows towards its columns downwards, 0 <= x < 180
    double prominence = 0;    ///< its power over the median of all directions at that period
};

/// Of a picture (one channel, or RGB turned grey), from 2.2 px to a quarter of the window; Welch's method over windows of
/// at most 256 px (Hann, half shared), power weighted with frequency so that uneven light does not count as a weave, refined
/// by the centre of mass of the peak. Empty where the picture is smaller than 32 px either way, constant, or no wave stands
/// out by `leastProminence`.
std::optional<DominantWave> dominantWave(const cv::Mat& picture, double leastProminence = 100);

/// The angle between two waves, 0..90.
double angleBetween(const DominantWave& a, const DominantWave& b);

}  // namespace rendering::signals
