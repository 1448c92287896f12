// Slopes and heights of a tile whose borders meet. There the Fourier transform makes integration exact (Frankot and
// Chellappa 1988): the height is the surface whose slopes are closest to the measured ones, and no border is fixed.
// surface_integration is for surfaces with free borders.
#pragma once

#include "rendering/signals/surface_integration.h"

namespace rendering::signals {

/// Height in the unit of `pitch` (mm), CV_32FC1, mean 0. `slopes`: CV_32FC1, at the centres of the pixels, finite. Their mean,
/// which no periodic surface can have, is ignored. Throws badInput like integrate().
cv::Mat integratePeriodic(const Slopes& slopes, const Pitch& pitch);

/// Slopes of a periodic surface (CV_32FC1) at the centres of its pixels; the inverse of integratePeriodic().
Slopes periodicSlopes(const cv::Mat& height, const Pitch& pitch);

/// Whether slopes along x and y belong to one surface. For each wave, a surface has slopes of the same phase.
struct SlopeAgreement {
    double agreement = 0;      ///< 1: one surface; -1: one surface whose slopes along y have the wrong sign; 0: unrelated
    double standardError = 0;  ///< of `agreement`, if the slopes were unrelated
    /// Whether the sign of the slopes along y is certain.
    bool isClear() const;
};

/// Compares slopes wave by wave, each weighted by its amplitude: a strong weave consists of few waves, whose slopes along x
/// and y come from different yarns. Waves shorter than 6.7 px are left out, because compression and sharpening disturb them,
/// and so are waves along x or y, which show one slope only.
SlopeAgreement slopeAgreement(const Slopes& slopes);

}  // namespace rendering::signals
