// The strongest wave of a picture; its period and direction characterise a weave.
#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>

namespace rendering::signals {

struct DominantWave {
    double periodPx = 0;
    double directionDeg = 0;  ///< direction of propagation, from the rows (0) towards the columns downwards; 0 <= x < 180
    double prominence = 0;    ///< power divided by the median power over all directions at this period
};

/// Finds the strongest wave with a period from 2.2 px to a quarter of the window. `picture`: one channel, or RGB, which
/// becomes grey. Welch's method averages Hann windows of at most 256 px that overlap by half. The power is weighted by
/// frequency, so that uneven light does not count as a weave. The centre of mass of the peak refines the result.
/// Returns nullopt where a side is shorter than 32 px, the picture is constant, or no prominence reaches `leastProminence`.
std::optional<DominantWave> dominantWave(const cv::Mat& picture, double leastProminence = 100);

/// Share of a picture's power that lies at a wave of it or of another picture of its size, 0 to 1: within 1.6 steps of the
/// spectrum's grid around it. Waves longer than a quarter of the window do not count, as uneven light is no weave. 0 for a
/// constant picture, and where a side is shorter than 32 px.
double waveShare(const cv::Mat& picture, const DominantWave& wave);

/// Angle between the directions of two waves, 0 to 90 degrees.
double angleBetween(const DominantWave& a, const DominantWave& b);

}  // namespace rendering::signals
