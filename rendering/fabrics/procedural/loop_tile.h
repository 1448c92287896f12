// One repeat of a weft knit as a height map.
#pragma once

#include <opencv2/core/mat.hpp>

#include "rendering/fabrics/procedural/structures.h"

namespace rendering::fabrics {

struct LoopTile {
    cv::Mat heightMm;  ///< CV_32FC1, periodic in both directions; a constant floor where there is no yarn
    double widthMm = 1;
    double lengthMm = 1;
};

/// Draws one repeat. Jersey: one face wale. Rib: two face wales and two back wales.
LoopTile drawLoops(const Structure& structure);

}  // namespace rendering::fabrics
