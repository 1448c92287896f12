// Areal roughness of a height map, after ISO 25178-2.
#pragma once

#include <opencv2/core/mat.hpp>

#include "rendering/signals/surface_integration.h"

namespace rendering::signals {

struct Roughness {
    double sqMm = 0;   ///< RMS height about the mean
    double sdr = 0;    ///< developed interfacial area ratio: area of the surface divided by its projection, minus 1
    double salMm = 0;  ///< autocorrelation length: the shortest distance at which the autocorrelation falls to 0.2
};

/// `heightMm`: one channel, finite. salMm is 0 for a constant map, and half the shorter side where the autocorrelation never
/// falls to 0.2. Throws badInput for an empty map or values that are not finite.
Roughness roughnessOf(const cv::Mat& heightMm, const Pitch& pitch);

/// Computes only salMm.
double autocorrelationLengthMm(const cv::Mat& heightMm, const Pitch& pitch);

}  // namespace rendering::signals
