#include "rendering/signals/shape_from_shading.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "rendering/signals/grey.h"

namespace rendering::signals {

namespace {

/// The waves longer than `longestPx`, or than half the image: a Gaussian that passes half of a wave of that length (ISO
/// 16610-21).
cv::Mat slowPart(const cv::Mat& values, double longestPx)
{
    const double length = std::min(longestPx, std::max(2.0, std::min(values.rows, values.cols) / 2.0));
    const double sigma = length * std::sqrt(std::log(2.0) / 2) / std::numbers::pi;
    cv::Mat slow;
    cv::GaussianBlur(values, slow, {}, sigma, sigma, cv::BORDER_REFLECT);
    return slow;
}

/// Brightness against that of the surroundings, minus 1: uneven light and the photograph's exposure drop
/// out, the slope along the light remains.
cv::Mat shadingOf(const cv::Mat& photograph, double longestPx)
{
    const cv::Mat light = grey(photograph);
    const cv::Mat surroundings = slowPart(light, longestPx);
    // Black surroundings have no relative brightness: a floor of a hundredth of the mean.
    const double floor = std::max(1e-6, 0.01 * cv::mean(light)[0]);
    cv::Mat difference, shading;
    cv::subtract(light, surroundings, difference);
    cv::divide(difference, cv::max(surroundings, floor), shading);
    return shading;
}

/// Around the photograph, its mirror image fading to 0, so that the transform's periodic continuation
/// puts no step at the border.
cv::Mat faded(const cv::Mat& shading, int margin, cv::Size full)
{
    cv::Mat wide;
    cv::copyMakeBorder(shading, wide, margin, full.height - shading.rows - margin, margin, full.width - shading.cols - margin,
                       cv::BORDER_REFLECT);
    const auto fade = [margin](int place, int length) {
        const int outside = std::max({margin - place, place - (margin + length - 1), 0});
        return outside >= margin ? 0.F : static_cast<float>(0.5 + 0.5 * std::cos(std::numbers::pi * outside / margin));
    };
    for (int i = 0; i < wide.rows; ++i)
        for (int j = 0; j < wide.cols; ++j) wide.at<float>(i, j) *= fade(i, shading.rows) * fade(j, shading.cols);
    return wide;
}

double frequency(int k, int n) { return (2 * k <= n ? k : k - n) / static_cast<double>(n); }

/// brightness = -(slope along the light), so height = brightness / (-2 pi i f), f along the light;
/// Tikhonov-regularised where f is small.
cv::Mat solved(const cv::Mat& shading, double azimuthDeg, double regularisation)
{
    const double angle = azimuthDeg * std::numbers::pi / 180;
    const double towardsX = std::cos(angle), towardsY = -std::sin(angle);  // image rows grow downwards
    const int margin = std::clamp(std::min(shading.rows, shading.cols) / 8, 1, 48);
    const cv::Size full(cv::getOptimalDFTSize(shading.cols + 2 * margin), cv::getOptimalDFTSize(shading.rows + 2 * margin));
    cv::Mat spectrum;
    cv::dft(faded(shading, margin, full), spectrum, cv::DFT_COMPLEX_OUTPUT);
    for (int i = 0; i < spectrum.rows; ++i)
        for (int j = 0; j < spectrum.cols; ++j) {
            const double f = frequency(j, full.width) * towardsX + frequency(i, full.height) * towardsY;
            const double gain = f / (2 * std::numbers::pi * (f * f + regularisation * regularisation));
            auto& bin = spectrum.at<cv::Vec2f>(i, j);
            bin = {static_cast<float>(-gain * bin[1]), static_cast<float>(gain * bin[0])};  // times i
        }
    cv::Mat height;
    cv::dft(spectrum, height, cv::DFT_INVERSE | cv::DFT_SCALE | cv::DFT_REAL_OUTPUT);
    const cv::Mat inside = height(cv::Rect(margin, margin, shading.cols, shading.rows));
    return inside - cv::mean(inside)[0];
}

Light lightOf(const cv::Mat& shading)
{
    cv::Mat smooth, x, y;
    cv::GaussianBlur(shading, smooth, {}, 1.0);
    cv::Sobel(smooth, x, CV_32F, 1, 0);
    cv::Sobel(smooth, y, CV_32F, 0, 1);
    const double xx = x.dot(x), yy = y.dot(y), xy = x.dot(y);
    Light light;
    if (!(xx + yy > 0)) return light;
    light.coherence = std::hypot(xx - yy, 2 * xy) / (xx + yy);
    if (light.coherence < 0.02) return light;
    const double axis = 0.5 * std::atan2(2 * xy, xx - yy);  // in image coordinates, rows downwards
    light.azimuthDeg = -axis * 180 / std::numbers::pi;      // -90 .. 90
    if (light.azimuthDeg < 10)
        light.azimuthDeg += 180;  // the upper end; of an axis that is nearly level, the left one
    return light;
}

}  // namespace

Light estimateLight(const cv::Mat& photograph, double highPassPx) { return lightOf(shadingOf(photograph, highPassPx)); }

cv::Mat shapeFromShading(const cv::Mat& photograph, const ShadingOptions& options)
{
    const cv::Mat shading = shadingOf(photograph, options.highPassPx);
    const double azimuthDeg = options.lightAzimuthDeg ? *options.lightAzimuthDeg : lightOf(shading).azimuthDeg;
    if (options.quality == ShadingQuality::Accurate) return solved(shading, azimuthDeg, options.regularisation);
    cv::Mat small, large;
    cv::resize(shading, small, {std::max(1, shading.cols / 2), std::max(1, shading.rows / 2)}, 0, 0, cv::INTER_AREA);
    // In the small image a pixel is two of the large one: half the wavelengths, half the heights.
    cv::resize(2 * solved(small, azimuthDeg, 2 * options.regularisation), large, shading.size(), 0, 0, cv::INTER_LINEAR);
    return large;
}

}  // namespace rendering::signals
