// A sensor calibrated on a surface whose height is known (a scan by the vendor, a roughness standard), instead of a ball:
// colour frames, or frames of one lamp each.
#pragma once

#include <opencv2/core/mat.hpp>

#include "rendering/signals/calibration.h"

namespace rendering::signals {

struct KnownSurfaceFrame {
    cv::Mat frame;      ///< as lightOf reads it
    cv::Mat reference;  ///< the untouched sensor; empty: light is measured against the frame's own illumination
    cv::Mat heightMm;   ///< CV_32FC1 or CV_64FC1, of the frame's size; NaN where unknown
    Pitch pitch;        ///< of the height map; x must equal y within 1 %
};

/// Learned from the rows first .. last - 1 only. Throws badInput where sizes differ or too few heights are known.
Calibration calibrationFrom(const KnownSurfaceFrame& surface, int first, int last, MapQuality quality = MapQuality::Balanced);

struct SurfaceScore {
    double slopeError = 0;     ///< mean absolute, mm/mm
    double heightErrorMm = 0;  ///< RMS after a quadratic surface is taken out, which slopes hardly tell
    double knownSqMm = 0;      ///< of the known surface there
};

/// How well it reads the rows first .. last - 1.
SurfaceScore scoreOf(const Calibration& calibration, const KnownSurfaceFrame& surface, int first, int last);

}  // namespace rendering::signals
