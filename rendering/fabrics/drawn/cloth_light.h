// The light that a piece of cloth reflects towards the camera.
#pragma once

#include "rendering/fabrics/drawn/cloth_camera.h"

namespace rendering::fabrics {

/// CV_32FC3, linear; 1 is white paper under full light. `sheen` is the share of mirrored light, `pitchMm` of the window.
/// `borderPx` is what lies outside the picture on each side.
cv::Mat reflectedLight(const ClothWindow& window, double sheen, double pitchMm, int borderPx, const ClothCamera& camera);

}  // namespace rendering::fabrics
