// A simulated GelSight sensor: a fabric pressed into a gel that three coloured lamps light from the side.
//
// Contact: the gel follows the fabric down to the depth that the press reaches below the highest yarns, with a soft
// transition. Its stiffness smooths the result (Gaussian). This indented relief is the ground truth of a sensor,
// in mm >= 0. It is quantised to 2^-13 mm, which compresses well.
// Light: lamps at 120 degrees around the gel, elevation 45 degrees. Each channel differs from the untouched gel by
// -gain * (slope along the direction of its lamp): linear for moderate slopes, softly saturating for steep ones.
// So frame - reference = 255 K [gx gy]. The inverse of K is the calibration that is stored with the data set
// (schema vis2hap.calibration/1, kind linear):
//   [dh/dx, dh/dy] = A [dR, dG, dB] + b, with d = (frame - reference) / 255, h towards the sensor,
//   x right, y down, slopes in mm per mm (central differences).
#pragma once

#include <opencv2/core/mat.hpp>
#include <string>

#include "protocols/random.h"
#include "rendering/fabrics/procedural/surface.h"

namespace rendering::fabrics {

inline constexpr int tactileWidthPx = 320;
inline constexpr int tactileHeightPx = 240;
inline constexpr double tactileMmPerPixel = 0.05;

struct Press {
    cv::Mat frame;     ///< CV_8UC3, RGB
    cv::Mat heightMm;  ///< CV_32FC1, indented relief
};

Press pressSensor(const FabricSurface& surface, const FabricPlace& place, protocols::Random& random);

/// Press of any surface: CV_32FC1, mm, of the size of the sensor.
Press pressSurface(const cv::Mat& surfaceMm, protocols::Random& random);

/// Frame of a known indentation, without the contact model.
cv::Mat tactileFrame(const cv::Mat& heightMm, protocols::Random& random);

/// Frame of the untouched sensor, averaged over many frames: CV_8UC3, RGB.
cv::Mat tactileReference();

/// Text of tactile-calibration.json.
std::string tactileCalibrationJson();

}  // namespace rendering::fabrics
