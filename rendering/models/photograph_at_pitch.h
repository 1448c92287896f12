// A photograph as a model sees it: at the pitch that the model was trained at, of a large one the middle.
#pragma once

#include "rendering/models/generation.h"

namespace rendering::models {

/// px at the model's pitch. Larger than any photograph of one place on a fabric needs to be; it bounds time and memory.
inline constexpr int largestSidePx = 2048;

struct SeenPhotograph {
    cv::Mat rgb;              ///< CV_8UC3, own memory
    cv::Rect part;            ///< what of the photograph is shown, its own pixels
    bool middleOnly = false;  ///< what lies outside of the middle largestSidePx was cut off
};

/// The pitch that a photograph of unknown scale is taken to have, mm a pixel: the model's, but where its weave (dominant_wave.h)
/// would then be finer than any the model was trained on, the one at which the weave has an ordinary period. So the networks
/// see threads, not noise; period and direction stay those of the photograph.
double assumedMmPerPixel(const cv::Mat& rgb, double modelMmPerPixel);

/// `mmPerPixel`: of the model; the photograph's own pitch must be known. Only what is shown is brought to it, so that large
/// photographs cost little.
SeenPhotograph photographAtPitch(const PhotographToTouch& photograph, double mmPerPixel);

/// The photograph with a lamp's slow falling off divided out (what varies over more than some 12 mm of fabric); its mean colour
/// stays. CV_8UC3 as `rgb`.
cv::Mat evenlyLit(const cv::Mat& rgb);

}  // namespace rendering::models
