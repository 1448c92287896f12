// A photograph as input of a model: scaled to the model's pitch and, if it is large, cropped to its middle.
#pragma once

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

/// Pitch that is assumed for a photograph of unknown scale, in mm per pixel. It is the model's pitch, unless the weave
/// (dominant_wave.h) would then be finer than any in the training data. In that case the weave gets an ordinary period, so
/// that the networks see threads and not noise. Period and direction of the photograph itself stay.
double assumedMmPerPixel(const cv::Mat& rgb, double modelMmPerPixel);

/// Pitch at which the threads of a photograph of unknown scale would be 0.45 mm apart, as in ordinary clothing, mm per pixel.
/// Without a clear weave nine pixels count as a thread.
double pitchOfOrdinaryThreads(const cv::Mat& rgb);

/// `mmPerPixel`: pitch of the model; the photograph's own pitch must be known. Only the used part is scaled, so that large
/// photographs cost little.
PhotographAtPitch photographAtPitch(const InputPhotograph& photograph, double mmPerPixel);

/// The photograph without the uneven light of a lamp: variation over more than about 12 mm of fabric is divided out, the mean
/// brightness stays. CV_8UC3 like `rgb`.
cv::Mat evenlyLit(const cv::Mat& rgb);

}  // namespace rendering::models
