#include "study/evaluation/pixel_ridge.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "protocols/random.h"
#include "rendering/signals/grey.h"

namespace study::evaluation {

namespace {

constexpr double ridgePenalty = 1e-3;  ///< of the mean diagonal
constexpr double rounding = 1e-6;      ///< of single precision, after some sums

/// 255 where a number stands; empty where every point has one.
cv::Mat measuredPoints(const cv::Mat& map)
{
    cv::Mat values;
    map.convertTo(values, CV_32F);
    const cv::Mat points = cv::abs(values) < 1e30;
    return cv::countNonZero(points) == static_cast<int>(points.total()) ? cv::Mat() : points;
}

/// The map with NaN outside of `points`.
cv::Mat keptAt(const cv::Mat& map, const cv::Mat& points)
{
    cv::Mat kept(map.size(), CV_32FC1, cv::Scalar(std::numeric_limits<float>::quiet_NaN())), values;
    map.convertTo(values, CV_32F);
    values.copyTo(kept, points);
    return kept;
}

cv::Mat smoothed(const cv::Mat& map, double sigmaPx)
{
    cv::Mat smooth;
    cv::GaussianBlur(map, smooth, {}, sigmaPx, sigmaPx, cv::BORDER_REFLECT);
    return smooth;
}

cv::Mat standardised(const cv::Mat& map)
{
    const cv::Mat texture = highPassed(map, usualHighPassPx);
    const cv::Mat points = measuredPoints(texture);
    const double least = points.empty() ? 0 : rounding * cv::norm(map, cv::NORM_INF, points);
    cv::Scalar mean, spread;
    cv::meanStdDev(texture, mean, spread, points);
    return spread[0] > least ? cv::Mat((texture - mean[0]) / spread[0]) : cv::Mat(texture - mean[0]);
}

cv::Mat inner(const cv::Mat& map, double marginPx)
{
    const int margin = std::min({int(std::ceil(marginPx)), (map.rows - 1) / 4, (map.cols - 1) / 4});
    return map(cv::Rect(margin, margin, map.cols - 2 * margin, map.rows - 2 * margin));
}

/// The inner part of a map without long waves, with mean 0; CV_64FC1. `points`, unless empty, are those that count, and others
/// are 0.
cv::Mat deviations(const cv::Mat& map, const cv::Mat& points, double sigmaPx)
{
    const bool isComplete = points.empty();
    cv::Mat values;
    inner(highPassed(isComplete ? map : keptAt(map, points), sigmaPx), sigmaPx).convertTo(values, CV_64F);
    if (isComplete) return values - cv::mean(values);
    const cv::Mat counted = inner(points, sigmaPx), others = counted == 0;
    values.setTo(0, others);
    values -= cv::mean(values, counted);
    values.setTo(0, others);
    const double least = rounding * cv::norm(map, cv::NORM_INF, points) * std::sqrt(double(cv::countNonZero(counted)));
    return cv::norm(values) > least ? values : cv::Mat::zeros(values.size(), CV_64FC1);
}

}  // namespace

std::size_t measuredCount(const cv::Mat& map)
{
    const cv::Mat points = measuredPoints(map);
    return points.empty() ? map.total() : static_cast<std::size_t>(cv::countNonZero(points));
}

cv::Mat highPassed(const cv::Mat& map, double sigmaPx)
{
    cv::Mat values;
    map.convertTo(values, CV_32F);
    const cv::Mat points = measuredPoints(values);
    if (points.empty()) return values - smoothed(values, sigmaPx);
    // The mean around a point is that of the measured points alone.
    cv::Mat known = cv::Mat::zeros(values.size(), CV_32FC1), weights, smooth;
    values.copyTo(known, points);
    points.convertTo(weights, CV_32F, 1.0 / 255);
    cv::divide(smoothed(known, sigmaPx), cv::max(smoothed(weights, sigmaPx), 1e-12), smooth);
    return keptAt(known - smooth, points);
}

double reliefCorrelation(const cv::Mat& relief, const cv::Mat& surface, double sigmaPx)
{
    const cv::Mat points = measuredPoints(surface);
    const cv::Mat a = deviations(relief, points, sigmaPx), b = deviations(surface, points, sigmaPx);
    const double spread = std::sqrt(a.dot(a) * b.dot(b));
    return spread > 0 ? a.dot(b) / spread : 0;
}

RidgeSums::RidgeSums() : m_squares(cv::Mat::zeros(inputs, inputs, CV_64FC1)), m_products(cv::Mat::zeros(inputs, 1, CV_64FC1)) {}

void RidgeSums::add(const cv::Mat& photograph, const cv::Mat& surface, int samples, std::uint64_t seed)
{
    CV_Assert(photograph.size() == surface.size());
    if (photograph.cols < windowPx || photograph.rows < windowPx) return;
    const cv::Mat pixels = standardised(rendering::signals::grey(photograph)), heights = standardised(surface);
    cv::Mat windows(samples, inputs, CV_32FC1), targets(samples, 1, CV_32FC1);
    protocols::Random random(seed);
    int kept = 0;
    for (int i = 0; i < samples; ++i) {
        const int x = int(random.below(std::uint64_t(pixels.cols - windowPx + 1)));
        const int y = int(random.below(std::uint64_t(pixels.rows - windowPx + 1)));
        const float height = heights.at<float>(y + windowPx / 2, x + windowPx / 2);
        if (!std::isfinite(height)) continue;
        pixels(cv::Rect(x, y, windowPx, windowPx)).clone().reshape(1, 1).copyTo(windows.row(kept));
        targets.at<float>(kept++) = height;
    }
    if (kept == 0) return;
    windows = windows.rowRange(0, kept);
    targets = targets.rowRange(0, kept);
    cv::Mat squares, products;
    cv::mulTransposed(windows, squares, true, cv::noArray(), 1, CV_64F);
    windows.convertTo(windows, CV_64F);
    targets.convertTo(targets, CV_64F);
    cv::gemm(windows, targets, 1, cv::noArray(), 0, products, cv::GEMM_1_T);
    m_squares += squares;
    m_products += products;
}

RidgeSums& RidgeSums::operator+=(const RidgeSums& other)
{
    m_squares += other.m_squares;
    m_products += other.m_products;
    return *this;
}

cv::Mat RidgeSums::weights() const
{
    const double penalty = ridgePenalty * cv::trace(m_squares)[0] / inputs;
    const cv::Mat system = m_squares + std::max(penalty, 1e-12) * cv::Mat::eye(inputs, inputs, CV_64FC1);
    cv::Mat solution, window;
    cv::solve(system, m_products, solution, cv::DECOMP_CHOLESKY);
    solution.reshape(1, windowPx).convertTo(window, CV_32F);
    return window;
}

cv::Mat ridgeRelief(const cv::Mat& photograph, const cv::Mat& weights)
{
    cv::Mat relief;
    cv::filter2D(standardised(rendering::signals::grey(photograph)), relief, CV_32F, weights, {-1, -1}, 0, cv::BORDER_REFLECT);
    return relief;
}

}  // namespace study::evaluation
