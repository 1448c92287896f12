// Areal roughness of a height map, after ISO 25178-2.
#pragma once

#include <opencv2/core/mat.hpp>

#include "rendering/signals/surface_integration.h"

namespace rendering::signals {

struct Roughness {
    double sqMm = 0;   ///< RMS height about the mean
    double sdr = 0;    ///< developed interfacial area ratio: surface area over its projection, less 1
    double salMm = 0;  ///< autocorrelation length: the shortest way over which the autocorrelation falls to 0.2
};

/// `heightMm`: one channel, finite. A constant map has no autocorrelation: salMm 0. A map whose autocorrelation never falls
/// so far has half its shorter side. Throws badInput for an empty map or values that are not finite.
Roughness roughnessOf(const cv::Mat& heightMm, const Pitch& pitch);

/// The third alone.
double autocorrelationLengthMm(const cv::Mat& heightMm, const Pitch& pitch);

}  // namespace rendering::signals
