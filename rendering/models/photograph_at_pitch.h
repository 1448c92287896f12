// A photograph as input of a model: scaled to the model's pitch and, if it is large, cropped to its middle.
#pragma once

#include "rendering/models/architecture.h"
#include "rendering/models/generation.h"

namespace rendering::models {

/// Largest side in px at the model's pitch. It exceeds any photograph of one place on a fabric and limits time and memory.
inline constexpr int largestSidePx = 2048;

/// Period of the finest weave of the training data at the model's pitch, px: silk satin at 0.05 mm per pixel.
inline constexpr double finestPeriodPx = 5;

struct PhotographAtPitch {
    cv::Mat rgb;              ///< CV_8UC3, own memory
    cv::Rect part;            ///< the part of the photograph that is used, in its own pixels
    bool middleOnly = false;  ///< true where the borders were cut off
};

/// Pitch that is assumed for a photograph of unknown scale, in mm per pixel. For networks that see, the threads are then 0.45 mm
/// apart, as in ordinary clothing; without a clear weave (dominant_wave.h) nine pixels count as a thread. For other networks it
/// is the model's pitch, unless the weave would be finer than finestPeriodPx; then the weave gets an ordinary period. Only the
/// middle, at most largestSidePx wide and high, counts.
double assumedMmPerPixel(const cv::Mat& rgb, const Architecture& architecture);

/// Finest weave that a photograph of stated scale should show, mm: thinner threads are rare, so the scale is doubtful.
double finestWeaveMm(const Architecture& architecture);

/// `mmPerPixel`: pitch of the model; the photograph's own pitch must be known. Only the used part is scaled, so that large
/// photographs cost little.
PhotographAtPitch photographAtPitch(const InputPhotograph& photograph, double mmPerPixel);

/// The part of a photograph, in its own pixels, whose signals generate() returns: all of it, or the middle of a large one.
cv::Rect usedPart(const InputPhotograph& photograph, const Architecture& architecture);

}  // namespace rendering::models
