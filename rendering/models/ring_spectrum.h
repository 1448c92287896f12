// Radial power spectrum of a height map in overlapping rings, and maps that are filtered to a wanted spectrum.
// The power of a texture at each wavelength hardly differs from place to place. So the spectrum is predicted from the
// photograph, like the mean friction, or taken from a known fabric, and imposed on the generated relief. Then heights
// and roughness do not depend on how sharply a network draws. No torch in this header.
#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "rendering/signals/tactile/calibration.h"

namespace rendering::models {

inline constexpr int ringCount = 24;
/// Added to every power before its logarithm, near the noise of the sensor. For brightness over its mean, the same number.
inline constexpr double ringFloorMm2 = 1e-6;

/// Position of a frequency (cycles per pixel) among the rings. It is 0 up to one cycle in `side` px and ringCount - 1 from
/// half a cycle per pixel. It is nearly linear for long waves and logarithmic for short ones. So the narrowest ring is
/// about as wide as the resolution of a window of `side` px. Rings are triangular weights that reach to the middles of
/// their neighbours, so that a line of the spectrum never jumps between rings.
double ringPlace(double frequency, int side);

/// Rows [ringCount][width x width] that average the powers of a window's frequencies (in the order of a complex transform)
/// into rings. A narrow ring without a frequency has the row of its neighbour.
cv::Mat ringAverages(int width, int side);

/// Natural logarithm of the mean power of each ring, in mm^2 or the square of the map's unit. White noise with standard
/// deviation s has power s^2. Welch's method is used with half overlapping Hann windows without their mean. Their width is
/// `side` to twice `side` px, as large as the map allows, because few long waves fit into a narrow window. A map smaller
/// than `side` px is mirrored. `heightMm`: CV_32FC1, finite.
std::vector<float> ringPowers(const cv::Mat& heightMm, int side);

/// Parameters of the filter to a wanted spectrum.
struct RingFilter {
    int side = 128;       ///< side of the map that the rings refer to, px
    double mostGain = 8;  ///< largest gain at any frequency; its inverse is the smallest
    int passes = 1;       ///< further passes reduce the deviation that smooth gains and clipping at 0 leave
    double zeroPercentile = signals::Calibration{}.zeroPercentile;  ///< percent of the result at or below 0, as in measured maps
};

/// Filters a map so that its ringPowers() are close to `wanted`, then applies zeroedRelief() (photometric_stereo.h). Waves
/// longer than `side`, which no press shows, fade out: half their height at one cycle per `side`. The filter keeps phases, and
/// its gain is smooth in frequency.
cv::Mat withRingPowers(const cv::Mat& heightMm, const std::vector<float>& wanted, const RingFilter& filter);

}  // namespace rendering::models
