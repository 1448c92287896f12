#include "rendering/models/lab/lab_heights.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace rendering::models {

namespace {

constexpr float unmeasured = std::numeric_limits<float>::quiet_NaN();
constexpr int fewestPoints = 100;

/// CV_8UC1, 255 where a number stands. NaN differs from itself, and infinities count as missing.
cv::Mat measuredPoints(const cv::Mat& map)
{
    cv::Mat points = cv::abs(map) < 1e30;
    return points;
}

/// The map with 0 for missing points, and their weights.
struct FilledMap {
    cv::Mat values, weights;
};

FilledMap filled(const cv::Mat& map)
{
    const cv::Mat points = measuredPoints(map);
    FilledMap result{cv::Mat::zeros(map.size(), CV_32F), {}};
    map.copyTo(result.values, points);
    points.convertTo(result.weights, CV_32F, 1.0 / 255);
    return result;
}

/// Weighted mean where the weight suffices, else NaN.
cv::Mat dividedWhere(const cv::Mat& sums, const cv::Mat& weights, double leastWeight)
{
    cv::Mat result(sums.size(), CV_32F, cv::Scalar(unmeasured)), quotient;
    cv::divide(sums, cv::max(weights, 1e-6), quotient);
    quotient.copyTo(result, weights >= leastWeight);
    return result;
}

cv::Mat blurred(const cv::Mat& map, double sigmaPx)
{
    cv::Mat result;
    const int reach = std::max(1, static_cast<int>(std::ceil(2.5 * sigmaPx)));
    cv::GaussianBlur(map, result, {2 * reach + 1, 2 * reach + 1}, sigmaPx, sigmaPx, cv::BORDER_REPLICATE);
    return result;
}

}  // namespace

cv::Mat scaledHeights(const cv::Mat& map, double factor)
{
    if (std::abs(factor - 1) < 1e-3) return map.clone();
    const cv::Size size(std::max(1, static_cast<int>(std::lround(map.cols * factor))),
                        std::max(1, static_cast<int>(std::lround(map.rows * factor))));
    const int how = factor < 1 ? cv::INTER_AREA : cv::INTER_LINEAR;
    FilledMap known = filled(map);
    cv::resize(known.values, known.values, size, 0, 0, how);
    cv::resize(known.weights, known.weights, size, 0, 0, how);
    return dividedWhere(known.values, known.weights, 0.5);
}

cv::Mat onPhotograph(const cv::Mat& heightMm, double mmPerPixel, const PixelGrid& photograph)
{
    // A coarser photograph averages first; warping alone would skip points.
    const double shrink = std::min(1.0, mmPerPixel / photograph.mmPerPixel);
    const cv::Mat map = scaledHeights(heightMm, shrink);
    const double pitch = mmPerPixel * heightMm.cols / map.cols, step = photograph.mmPerPixel / pitch;
    const double turn = photograph.turnDeg * CV_PI / 180, across = step * std::cos(turn), down = step * std::sin(turn);
    const double centreX = (photograph.size.width - 1) / 2.0, centreY = (photograph.size.height - 1) / 2.0;
    const cv::Mat toMap = (cv::Mat_<double>(2, 3) << across, -down, (map.cols - 1) / 2.0 - across * centreX + down * centreY,
                           down, across, (map.rows - 1) / 2.0 - down * centreX - across * centreY);
    const FilledMap known = filled(map);
    cv::Mat values, weights;
    for (const auto& [from, to] : {std::pair{&known.values, &values}, {&known.weights, &weights}})
        cv::warpAffine(*from, *to, toMap, photograph.size, cv::INTER_LINEAR | cv::WARP_INVERSE_MAP, cv::BORDER_CONSTANT,
                       cv::Scalar(0));
    return dividedWhere(values, weights, 0.5);
}

cv::Mat withoutSlowHeights(const cv::Mat& map, double sigmaPx)
{
    const FilledMap known = filled(map);
    cv::Mat slow;
    cv::divide(blurred(known.values, sigmaPx), cv::max(blurred(known.weights, sigmaPx), 1e-3), slow);
    return map - slow;
}

double deviationOf(const cv::Mat& map)
{
    const cv::Mat points = measuredPoints(map);
    if (cv::countNonZero(points) < fewestPoints) return std::numeric_limits<double>::quiet_NaN();
    cv::Scalar mean, deviation;
    cv::meanStdDev(filled(map).values, mean, deviation, points);
    return deviation[0];
}

double correlationOfHeights(const cv::Mat& a, const cv::Mat& b)
{
    const cv::Mat both = measuredPoints(a) & measuredPoints(b);
    if (cv::countNonZero(both) < fewestPoints) return std::numeric_limits<double>::quiet_NaN();
    const cv::Mat left = filled(a).values, right = filled(b).values;
    cv::Scalar leftMean, leftDeviation, rightMean, rightDeviation;
    cv::meanStdDev(left, leftMean, leftDeviation, both);
    cv::meanStdDev(right, rightMean, rightDeviation, both);
    if (!(leftDeviation[0] > 0 && rightDeviation[0] > 0)) return std::numeric_limits<double>::quiet_NaN();
    const double product = cv::mean(left.mul(right), both)[0];
    return (product - leftMean[0] * rightMean[0]) / (leftDeviation[0] * rightDeviation[0]);
}

double measuredShare(const cv::Mat& map)
{
    return map.empty() ? 0 : cv::countNonZero(measuredPoints(map)) / static_cast<double>(map.total());
}

}  // namespace rendering::models
