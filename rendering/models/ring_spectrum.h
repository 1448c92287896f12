// The radial power spectrum of a height map in overlapping rings, and maps brought to a wanted one.
// A texture's power at every wavelength hardly differs from place to place: it is predicted from the
// photograph as its own quantity (like the mean friction), or remembered of its fabric, and imposed on the generated relief, so
// that heights and roughness do not depend on how sharp a network draws. No torch in this header.
#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "rendering/signals/calibration.h"

namespace rendering::models {

inline constexpr int ringCount = 24;
/// Added to every power before its logarithm: the noise of the sensor lies there. Of brightness over its mean: the same number.
inline constexpr double ringFloorMm2 = 1e-6;

/// Where a frequency in cycles a pixel lies among the rings: 0 at one cycle in `side` px (or below), ringCount - 1
/// at half a cycle a pixel (or above); in between near-linear for long waves and logarithmic for short ones, so
/// that the narrowest ring is about as wide as a window of `side` px can tell apart. A ring weighs the
/// frequencies around its middle by a triangle that reaches to its neighbours' middles: a line of the spectrum
/// never jumps from one to the next.
double ringPlace(double frequency, int side);

/// [ringCount][width x width] rows that average the powers of a window's frequencies (the order of a complex
/// transform) into rings; a narrow ring that holds no frequency has its neighbour's row.
cv::Mat ringAverages(int width, int side);

/// Natural logarithms of the mean power of each ring, mm^2 or the square of the map's unit (white noise of deviation s gives
/// s^2): Welch's method (Hann windows, each without its mean, half shared with the next) with the widest windows that fit, `side`
/// to twice `side` px, since few long waves fit into a narrow one. A map smaller than a window of `side` px is continued by
/// mirroring. `heightMm`: CV_32FC1, finite.
std::vector<float> ringPowers(const cv::Mat& heightMm, int side);

/// How a map is brought to a wanted spectrum.
struct RingFilter {
    int side = 128;       ///< of the rings, px
    double mostGain = 8;  ///< of any frequency, either way
    int passes = 1;       ///< what smooth gains and cutting at 0 leave apart, further passes bring nearer
    double zeroPercentile =
        signals::Calibration{}.zeroPercentile;  ///< percent of the result that lies at 0, as measured maps are settled
};

/// The map filtered so that ringPowers() are near `wanted`, then settled as a measured one (photometric_stereo.h).
/// Waves longer than `side`, which no press has, fade out (half their height at one cycle a side). Phases are kept,
/// the gain is smooth in frequency.
cv::Mat withRingPowers(const cv::Mat& heightMm, const std::vector<float>& wanted, const RingFilter& filter);

}  // namespace rendering::models
