// Slopes to height: the surface whose differences come closest to the measured slopes (least squares,
// free borders), solved exactly by the cosine transform. A tilt stays a tilt; no border is pinned.
// The height of the whole is not in the slopes: the mean of the result is 0.
#pragma once

#include <opencv2/core/mat.hpp>

namespace rendering::signals {

/// Distance between pixels along x (columns) and y (rows), mm.
struct Pitch {
    double x = 1;
    double y = 1;
};

/// dh/dx (x to the right) and dh/dy (y downwards), mm/mm. CV_32FC1 or CV_64FC1, of one size.
struct Slopes {
    cv::Mat x;
    cv::Mat y;
};

/// What a slope says. Point: the slope at the pixel's centre; neighbours are averaged to the slope
/// between them. Forward: the rise from the pixel to its right (lower) neighbour; the last is unused.
enum class SlopeKind { Point, Forward };

/// Full solves in double precision and returns CV_64FC1; Fast in single precision, CV_32FC1.
enum class IntegrationQuality { Full, Fast };

/// Height, mm, of the slopes' size, mean 0. Throws badInput where sizes differ, a value is not
/// finite, or the pitch is not positive.
cv::Mat integrate(const Slopes& slopes, const Pitch& pitch, SlopeKind kind = SlopeKind::Point,
                  IntegrationQuality quality = IntegrationQuality::Full);

/// How far point slopes are from being those of any surface: RMS circulation around the cells between
/// pixels over the RMS change of slope that enters it. 0 for a surface, about 1 for noise.
double curlResidual(const Slopes& slopes, const Pitch& pitch);

/// The surface without its parts longer than the cut-off: ISO 16610-21 Gaussian filter, which passes
/// half of a wave of `cutoffMm`; free borders. The mean becomes 0. Depth is kept.
cv::Mat withoutLowFrequency(const cv::Mat& heightMm, const Pitch& pitch, double cutoffMm);

}  // namespace rendering::signals
