// Slopes to height: the surface whose differences come closest to the measured slopes (least squares,
// free borders), solved exactly by the cosine transform. A tilt stays a tilt; no border is pinned.
// The height of the whole is not in the slopes: the mean of the result is 0.
//
// No single kernel suits every kind of slope. The kind is said by whoever measured, and what is solved
// follows from it:
//   Point    the slope at the pixel's centre. The rise between two neighbours is the integral of the
//            polynomial through the six slopes around it (0.1 % off on a weave of 6 pixels, where their
//            mean is 2.4 % off); then least squares over the rises.
//   Central  half the difference of the two neighbours, one-sided at the borders (numpy.gradient).
//            Inverted as such: with weight 1/2 at the borders it is diagonal in the cosine transform, and a
//            surface comes back to rounding.
//   Forward  the rise from the pixel to its right (lower) neighbour over the pitch; the last is unused.
#pragma once

#include <opencv2/core/mat.hpp>
#include <string_view>

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

enum class SlopeKind { Point, Central, Forward };

/// "point", "central", "forward". Throws badInput for any other.
SlopeKind slopeKindNamed(std::string_view name);

/// Full solves in double precision and returns CV_64FC1; Fast in single precision, CV_32FC1.
enum class IntegrationQuality { Full, Fast };

/// Height, mm, of the slopes' size, mean 0. Throws badInput where sizes differ, a value is not
/// finite, or the pitch is not positive.
cv::Mat integrate(const Slopes& slopes, const Pitch& pitch, SlopeKind kind = SlopeKind::Point,
                  IntegrationQuality quality = IntegrationQuality::Full);

/// Where both slopes are finite: CV_8UC1, 255 there.
cv::Mat measuredPlaces(const Slopes& slopes);

/// The same surface where some slopes are missing: not finite, or 0 in `measured` (CV_8UC1, may be
/// empty). They count a thousandth, with slopes continued from around them, so that gaps are bridged smoothly and
/// what is measured is not bent towards them; conjugate gradients, preconditioned by the full solution. In double
/// precision. Throws badInput as `integrate`, and where nothing at all was measured.
cv::Mat integrateAround(const Slopes& slopes, const cv::Mat& measured, const Pitch& pitch, SlopeKind kind = SlopeKind::Point);

/// The share of the slopes that no surface has (their curl part): RMS of what `heightMm`, integrated from them, leaves
/// unexplained over RMS of the slopes. 0 for a surface, 0.7 for noise. Slopes that are not finite are left out.
double curlResidual(const Slopes& slopes, const cv::Mat& heightMm, const Pitch& pitch, SlopeKind kind = SlopeKind::Point);

/// The surface without its parts longer than the cut-off: ISO 16610-21 Gaussian filter, which passes
/// half of a wave of `cutoffMm`; free borders. The mean becomes 0. Depth is kept.
cv::Mat withoutLowFrequency(const cv::Mat& heightMm, const Pitch& pitch, double cutoffMm);

/// The surface without the plane that fits it best at `places` (CV_8UC1, not 0 there; empty: everywhere), which come to lie
/// about 0. Depth is kept. Throws badInput for fewer than three places.
cv::Mat withoutTilt(const cv::Mat& heightMm, const cv::Mat& places);

}  // namespace rendering::signals
