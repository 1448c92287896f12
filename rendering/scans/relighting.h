// A scanned fabric under a lamp: its colour, which was measured without light, times the light that its measured slopes
// receive. Matt cloth (Lambert), a distant lamp, no cast shadows.
#pragma once

#include <opencv2/core/mat.hpp>

#include "rendering/scans/scan.h"

namespace rendering::scans {

/// Height of the lamp above the cloth: low, as for a photograph that shall show a weave.
inline constexpr double lampElevationDeg = 30;
/// Side of the one lamp that all fabrics share: upper left.
inline constexpr double oneLampDeg = 135;
/// Sides of the four lamps.
inline constexpr double fourLampsDeg[] = {45, 135, 225, 315};

/// CV_8UC3, RGB, of the size of the scan. `sideDeg`: side from which the light comes, 0 right, 90 top, anticlockwise. The
/// exposure keeps the colour of level cloth, or is lower so that at most a two-hundredth of the pixels is clipped.
cv::Mat relit(const Scan& scan, double sideDeg);

}  // namespace rendering::scans
