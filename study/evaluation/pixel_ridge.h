// The plainest way to see relief in a photograph: a ridge regression from the 15 x 15 pixels around a place to its height. It is
// a control for generators, fitted without the fabric that it is tested on.
#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

namespace study::evaluation {

/// Gaussian whose result is subtracted from photographs and surfaces, px.
inline constexpr double usualHighPassPx = 16;

/// Number of points that are finite. Others were not measured.
std::size_t measuredCount(const cv::Mat& map);

/// A map without its long waves: CV_32FC1, of the same size. Borders are mirrored. Points that are not finite are left out, and
/// are NaN in the result.
cv::Mat highPassed(const cv::Mat& map, double sigmaPx);

/// Pearson correlation of two maps of one size, both high-passed, without the `sigmaPx` pixels at their borders; 0 where one
/// does not vary. Nothing is shifted: both maps lie on the same pixels. Points that are not finite in `surface` are left out of
/// both.
double reliefCorrelation(const cv::Mat& relief, const cv::Mat& surface, double sigmaPx = usualHighPassPx);

/// Sums of squares and products of pixels and heights, which can be added up over fabrics.
class RidgeSums {
public:
    static constexpr int windowPx = 15, inputs = windowPx * windowPx;

    RidgeSums();
    /// Adds `samples` places of a photograph (CV_8UC3) and its surface (CV_32FC1, of the same size), drawn by seed. Both count
    /// with variance 1. Drawn places without a measured height add nothing, nor does a photograph smaller than the window.
    void add(const cv::Mat& photograph, const cv::Mat& surface, int samples, std::uint64_t seed);
    RidgeSums& operator+=(const RidgeSums& other);

    /// Weights of the window (CV_32FC1, 15 x 15). The penalty is a thousandth of the mean diagonal of the normal equations.
    cv::Mat weights() const;

private:
    cv::Mat m_squares, m_products;  ///< CV_64FC1
};

/// The relief that the weights see in a photograph, without scale; CV_32FC1.
cv::Mat ridgeRelief(const cv::Mat& photograph, const cv::Mat& weights);

}  // namespace study::evaluation
