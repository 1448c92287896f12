// Integration of slopes to height: the surface whose differences are closest to the measured slopes (least squares,
// free borders), solved exactly by the cosine transform. A tilt remains a tilt; no border is fixed. Slopes do not
// contain the mean height, so the mean of the result is 0.
//
// Each kind of slope needs its own kernel, so the caller states the kind:
//   Point    the slope at the centre of the pixel. The rise between two neighbours is the integral of the polynomial
//            through the six slopes around it. On a weave with 6 pixels per period its error is 0.1 %; the mean of two
//            slopes has 2.4 %. Then least squares over the rises.
//   Central  half the difference of the two neighbours, one-sided at the borders (numpy.gradient). With weight 1/2
//            at the borders this operator is diagonal in the cosine transform, so its inversion is exact.
//   Forward  the rise from the pixel to its right (lower) neighbour divided by the pitch; the last one is unused.
#pragma once

#include <opencv2/core/mat.hpp>
#include <string_view>

namespace rendering::signals {

/// Distance between pixels along x (columns) and y (rows), mm.
struct Pitch {
    double x = 1;
    double y = 1;
};

/// dh/dx (x to the right) and dh/dy (y downwards), mm/mm. CV_32FC1 or CV_64FC1, both of one size.
struct Slopes {
    cv::Mat x;
    cv::Mat y;
};

enum class SlopeKind { Point, Central, Forward };

/// Reads "point", "central" or "forward". Throws badInput for any other.
SlopeKind slopeKindNamed(std::string_view name);

/// Full computes in double precision and returns CV_64FC1; Fast computes in single precision and returns CV_32FC1.
enum class IntegrationQuality { Full, Fast };

/// Height in mm with the size of the slopes and mean 0. Throws badInput where sizes differ, a value is not finite, or the
/// pitch is not positive.
cv::Mat integrate(const Slopes& slopes, const Pitch& pitch, SlopeKind kind = SlopeKind::Point,
                  IntegrationQuality quality = IntegrationQuality::Full);

/// Mask of the pixels at which both slopes are finite: CV_8UC1, 255 there.
cv::Mat measuredPlaces(const Slopes& slopes);

/// Height in mm where some slopes are missing: not finite, or 0 in `measured` (CV_8UC1; may be empty). Missing slopes are
/// continued from their surroundings. Point and Forward: least squares in which rises at a gap have a thousandth of the weight,
/// solved by multigrid (gap_multigrid.h); a single row or column is summed. Central: the interleaved lattices are integrated one
/// by one and joined (joined_lattices.h); a slope is used even where the other one is missing. A part that gaps cut off keeps its
/// shape; how high it lies is a guess. CV_64FC1, mean 0. Throws badInput like `integrate`, where nothing was measured, and where
/// slopes beside gaps exceed 32-bit numbers. Throws workFailed where the heights around the gaps are not found: a residual above
/// 1e-4 of the sources, or above 5e-4 for more than 4 million pixels of point or forward slopes.
cv::Mat integrateAround(const Slopes& slopes, const cv::Mat& measured, const Pitch& pitch, SlopeKind kind = SlopeKind::Point);

/// RMS of the part of the slopes that no surface can have (their curl), relative to the RMS of the slopes. `heightMm` is the
/// integrated surface. 0 for the slopes of a surface, 0.7 for noise. Slopes that are not finite are left out.
double curlResidual(const Slopes& slopes, const cv::Mat& heightMm, const Pitch& pitch, SlopeKind kind = SlopeKind::Point);

/// Height without waves longer than the cut-off: Gaussian filter of ISO 16610-21, which passes half of a wave of `cutoffMm`;
/// free borders. The mean becomes 0. The depth of the image stays.
cv::Mat withoutLowFrequency(const cv::Mat& heightMm, const Pitch& pitch, double cutoffMm);

/// Height without its best-fitting plane at `places` (CV_8UC1, not 0; empty: everywhere), where its mean becomes 0. The
/// depth of the image stays. Throws badInput for fewer than three places.
cv::Mat withoutTilt(const cv::Mat& heightMm, const cv::Mat& places);

}  // namespace rendering::signals
