// A piece of a drawn fabric: the relief at any pitch, and what a camera needs of it.
#pragma once

#include <opencv2/core/mat.hpp>

#include "rendering/fabrics/drawn/drawn_fabric.h"
#include "rendering/fabrics/procedural/surface.h"

namespace rendering::fabrics {

/// CV_32FC1 of equal size, but `colour`, which is CV_32FC3.
struct ClothWindow {
    cv::Mat heightMm;                      ///< above the mid-plane of the cloth, with its slack; may be negative
    cv::Mat tangentX, tangentY, tangentZ;  ///< direction of the fibres, x right, y down, z up; 0 where no yarn lies
    cv::Mat colour;                        ///< linear reflectance
    cv::Mat cover;                         ///< 1 where a yarn lies, 0 in the gaps
    double textureSqMm = 0;                ///< standard deviation of the height without the slack
};

enum class SlackShown { No, Yes };

/// Samples `size` pixels of `pitchMm` around `place`. Places agree between windows. Cost grows with the number of yarns.
ClothWindow clothWindow(const DrawnFabric& fabric, const FabricPlace& place, cv::Size size, double pitchMm,
                        SlackShown slack = SlackShown::Yes);

}  // namespace rendering::fabrics
