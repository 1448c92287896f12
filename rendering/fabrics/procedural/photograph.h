// A simulated photograph of a patch of fabric, taken by a camera above it.
//
// Light: Lambert shading under one lamp and the sky, and a specular share for shiny yarns (Blinn-Phong).
// Hollows are darker by their depth below the surroundings, a simple ambient occlusion. Each yarn has its
// own reflectance; loose fibres are thin bright lines.
// Camera: vignetting, blur, shot noise and read noise, gamma 1/2.2, 8 bits.
#pragma once

#include <opencv2/core/mat.hpp>

#include "protocols/random.h"
#include "rendering/fabrics/procedural/surface.h"

namespace rendering::fabrics {

inline constexpr int photographSizePx = 256;
inline constexpr double photographMmPerPixel = 0.05;

/// CV_8UC3, RGB. `random` draws the lamp, exposure, white balance and noise.
cv::Mat photograph(const FabricSurface& surface, const FabricPlace& place, protocols::Random& random);

}  // namespace rendering::fabrics
