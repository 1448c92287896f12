// A simulated GelSight: a fabric pressed into a gel that three coloured lamps light from the side.
//
// Contact: the gel follows the fabric down to the depth that the press reaches below the highest
// yarns (softly), and its own stiffness smooths what it follows (Gaussian). The indented relief is
// what a sensor could measure, mm >= 0, quantised to 2^-13 mm so that it packs well.
// Light: lamps at 120 degrees around the gel, elevation 45 degrees; each channel changes against the
// untouched gel by -gain * (slope along its lamp's direction), linear for moderate slopes and
// saturating softly for steep ones. So frame - reference = 255 K [gx gy], and the inverse of K is
// the calibration stored with the data set (schema vis2hap.calibration/1, kind linear):
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

Press pressSensor(const FabricSurface& surface, const Place& place, protocols::Random& random);

/// The frame of a known indentation, without contact model.
cv::Mat tactileFrame(const cv::Mat& heightMm, protocols::Random& random);

/// The untouched sensor, averaged over many frames: CV_8UC3, RGB.
cv::Mat tactileReference();

/// Text of tactile-calibration.json.
std::string tactileCalibrationJson();

}  // namespace rendering::fabrics
