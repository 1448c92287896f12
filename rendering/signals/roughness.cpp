#include "rendering/signals/roughness.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "protocols/files/errors.h"

namespace rendering::signals {

namespace {

constexpr double fallsTo = 0.2;
constexpr int directions = 72;  ///< over 180 degrees

void requireMap(const cv::Mat& height)
{
    if (height.empty() || height.channels() != 1 || !cv::checkRange(height))
        throw protocols::badInput({.what = "the height map is empty or holds values that are not finite",
                                   .where = "",
                                   .expected = "a finite height at every pixel",
                                   .nextStep = "fill the gaps of the height map"});
}

cv::Mat centred(const cv::Mat& height)
{
    cv::Mat values;
    height.convertTo(values, CV_32F);
    values -= cv::mean(values)[0];
    return values;
}

/// Autocorrelation of a zero-padded map. Lag (i, j) lies at (i, j), negative lags at the far end.
cv::Mat autocorrelation(const cv::Mat& values)
{
    const cv::Size size(cv::getOptimalDFTSize(2 * values.cols), cv::getOptimalDFTSize(2 * values.rows));
    cv::Mat wide = cv::Mat::zeros(size, CV_32FC1), spectrum, result;
    values.copyTo(wide(cv::Rect(cv::Point(), values.size())));
    cv::dft(wide, spectrum, 0, values.rows);
    cv::mulSpectrums(spectrum, spectrum, spectrum, 0, true);
    cv::idft(spectrum, result, cv::DFT_SCALE);
    return result;
}

double correlationAt(const cv::Mat& correlation, int i, int j)
{
    return correlation.at<float>(i < 0 ? i + correlation.rows : i, j < 0 ? j + correlation.cols : j);
}

/// Bilinear value between four lags; each is divided by the share of the map that overlaps itself at this lag.
double sample(const cv::Mat& correlation, cv::Size map, double x, double y)
{
    const int i = static_cast<int>(std::floor(y)), j = static_cast<int>(std::floor(x));
    const double v = y - i, u = x - j;
    const auto value = [&](int row, int column) {
        return correlationAt(correlation, row, column) / ((1.0 - std::abs(row) / static_cast<double>(map.height)) *
                                                          (1.0 - std::abs(column) / static_cast<double>(map.width)));
    };
    return (1 - v) * ((1 - u) * value(i, j) + u * value(i, j + 1)) + v * ((1 - u) * value(i + 1, j) + u * value(i + 1, j + 1));
}

/// Distance along one direction, in steps of half the finer pitch, at which the autocorrelation has fallen; `most` where it
/// does not fall.
double fallLength(const cv::Mat& correlation, cv::Size map, const Pitch& pitch, double angle, double most)
{
    const double step = 0.5 * std::min(pitch.x, pitch.y), origin = correlationAt(correlation, 0, 0);
    double before = 1;
    for (double length = step; length < most; length += step) {
        const double now =
            sample(correlation, map, length * std::cos(angle) / pitch.x, length * std::sin(angle) / pitch.y) / origin;
        if (now <= fallsTo) return length - step * (fallsTo - now) / std::max(1e-12, before - now);
        before = now;
    }
    return most;
}

double surfaceAreaRatio(const cv::Mat& values, const Pitch& pitch)
{
    double sum = 0;
    for (int i = 0; i + 1 < values.rows; ++i)
        for (int j = 0; j + 1 < values.cols; ++j) {
            const double a = values.at<float>(i, j), b = values.at<float>(i, j + 1), c = values.at<float>(i + 1, j),
                         d = values.at<float>(i + 1, j + 1);
            const double x = (b - a + d - c) / (2 * pitch.x), y = (c - a + d - b) / (2 * pitch.y);
            sum += std::sqrt(1 + x * x + y * y) - 1;
        }
    const double cells = (values.rows - 1.0) * (values.cols - 1.0);
    return cells > 0 ? sum / cells : 0;
}

}  // namespace

double autocorrelationLengthMm(const cv::Mat& heightMm, const Pitch& pitch)
{
    requireMap(heightMm);
    const cv::Mat values = centred(heightMm);
    const cv::Mat correlation = autocorrelation(values);
    if (!(correlationAt(correlation, 0, 0) > 0)) return 0;
    const double most = 0.5 * std::min((values.cols - 1) * pitch.x, (values.rows - 1) * pitch.y);
    double shortest = std::max(most, 0.0);
    for (int k = 0; k < directions; ++k)
        shortest = std::min(shortest, fallLength(correlation, values.size(), pitch, CV_PI * k / directions, shortest));
    return shortest;
}

Roughness roughnessOf(const cv::Mat& heightMm, const Pitch& pitch)
{
    requireMap(heightMm);
    const cv::Mat values = centred(heightMm);
    return {cv::norm(values) / std::sqrt(static_cast<double>(values.total())), surfaceAreaRatio(values, pitch),
            autocorrelationLengthMm(heightMm, pitch)};
}

}  // namespace rendering::signals
