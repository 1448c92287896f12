// A photograph of a patch of fabric as a camera above it would take it.
//
// Lambert shading under one lamp and the sky, a mirrored share for shiny yarns (Blinn-Phong), darker
// hollows (height against its surroundings, a cheap ambient occlusion), loose fibres as thin bright
// lines, reflectance by yarn; then vignetting, camera blur, shot and read noise, gamma 1/2.2, 8 bits.
#pragma once

#include <opencv2/core/mat.hpp>

#include "protocols/random.h"
#include "rendering/fabrics/procedural/surface.h"

namespace rendering::fabrics {

inline constexpr int photographSizePx = 256;
inline constexpr double photographMmPerPixel = 0.05;

/// CV_8UC3, RGB. Lamp, exposure, white balance and noise are drawn from `random`.
cv::Mat photograph(const FabricSurface& surface, const Place& place, protocols::Random& random);

}  // namespace rendering::fabrics
