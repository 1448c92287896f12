// Calibration of a sensor on a surface of known height (a vendor's scan, a roughness standard) instead of a ball. The
// frames are in colour, or there is one for each lamp.
#pragma once

#include <opencv2/core/mat.hpp>

#include "rendering/signals/tactile/calibration.h"
#include "rendering/signals/tactile/slope_map_fit.h"

namespace rendering::signals {

struct KnownSurfaceFrame {
    cv::Mat frame;      ///< as lightOf() takes it
    cv::Mat reference;  ///< frame of the untouched sensor; if empty, light is measured against the frame's own illumination
    cv::Mat heightMm;   ///< CV_32FC1 or CV_64FC1, size of the frame; NaN where unknown
    Pitch pitch;        ///< pitch of the height map; x and y must be equal within 1 %
};

/// Fits a map to the rows first to last - 1 only. Throws badInput where sizes differ, too few heights are known, or heights are
/// no floating-point numbers in mm: more than half of the surface steeper than 10 mm/mm is of another unit.
Calibration calibrationFrom(const KnownSurfaceFrame& surface, int first, int last, MapQuality quality = MapQuality::Balanced);

struct SurfaceScore {
    double slopeError = 0;     ///< mean absolute error, mm/mm
    double heightErrorMm = 0;  ///< RMS error after removal of a quadratic surface, which slopes determine poorly
    double knownSqMm = 0;      ///< RMS height of the known surface in these rows
};

/// Accuracy of a calibration on the rows first to last - 1.
SurfaceScore scoreOf(const Calibration& calibration, const KnownSurfaceFrame& surface, int first, int last);

}  // namespace rendering::signals
