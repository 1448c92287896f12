// A photograph as a model sees it: at the pitch that the model was trained at, of a large one the middle.
#pragma once

#include "rendering/models/generation.h"

namespace rendering::models {

/// px at the model's pitch. Larger than any photograph of one place on a fabric needs to be; it bounds time and memory.
inline constexpr int largestSidePx = 2048;

struct SeenPhotograph {
    cv::Mat rgb;              ///< CV_8UC3, own memory
    bool middleOnly = false;  ///< what lies outside of the middle largestSidePx was cut off
};

/// `mmPerPixel`: of the model. Only what is shown is brought to it, so that large photographs cost little.
SeenPhotograph photographAtPitch(const PhotographToTouch& photograph, double mmPerPixel);

}  // namespace rendering::models
