// The radial power spectrum of a height map in rings of equal ratio, and maps brought to a wanted one.
// A texture's power at every wavelength hardly differs from place to place: it is predicted from the
// photograph as its own quantity (like the mean friction) and imposed on the generated relief, so that
// heights and roughness do not depend on how sharp a network draws. No torch in this header.
#pragma once

#include <opencv2/core/mat.hpp>

#include <vector>

namespace rendering::models {

inline constexpr int ringCount = 24;
/// Added to every power before its logarithm: the noise of the sensor lies there.
inline constexpr double ringFloorMm2 = 1e-6;

/// Natural logarithms of the mean power of each ring, mm^2 (white noise of deviation s mm gives s^2);
/// Welch's method over windows of `side` x `side` px (Hann, each without its mean, half shared with the
/// next). Rings in equal ratios from 1.5 cycles a window to half a cycle a pixel; a narrow ring that holds
/// no frequency of the window takes its lower neighbour's value, the first is 0 then and never used. A map
/// smaller than a window is continued by mirroring. `heightMm`: CV_32FC1, finite.
std::vector<float> ringPowers(const cv::Mat& heightMm, int side);

/// The map filtered so that ringPowers() are near `wanted`; waves longer than the rings', which no press
/// has, fade out (half their height at one cycle a window). Phases are kept, the gain is smooth in
/// frequency and bounded by a factor of `mostGain` either way, the mean is kept, heights stay >= 0. What
/// cutting at 0 and smooth gains leave apart, further `passes` bring nearer.
cv::Mat withRingPowers(const cv::Mat& heightMm, const std::vector<float>& wanted, int side, double mostGain = 4, int passes = 1);

}  // namespace rendering::models
