#include "rendering/scans/relighting.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace rendering::scans {

namespace {

constexpr double clippedShare = 0.005;
constexpr int histogramBins = 1024;
constexpr float brightestShade = 4;  ///< of the histogram; level cloth has 1

double linearOf(double stored) { return stored <= 0.04045 ? stored / 12.92 : std::pow((stored + 0.055) / 1.055, 2.4); }
double storedOf(double linear) { return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055; }

/// sRGB (IEC 61966-2-1) as tables: the power function would take most of the time.
struct Curves {
    std::array<float, 256> linear;
    std::array<uchar, 4096> stored;
    Curves()
    {
        for (std::size_t i = 0; i < linear.size(); ++i) linear[i] = static_cast<float>(linearOf(double(i) / 255));
        for (std::size_t i = 0; i < stored.size(); ++i)
            stored[i] = static_cast<uchar>(std::lround(255 * storedOf((double(i) + 0.5) / double(stored.size()))));
    }
};

/// Light that each pixel receives; 1 for level cloth, 0 for cloth that turns away from the lamp.
cv::Mat shadeOf(const signals::Slopes& slopes, double sideDeg)
{
    const double side = sideDeg * std::numbers::pi / 180, height = lampElevationDeg * std::numbers::pi / 180;
    const auto x = static_cast<float>(std::cos(side) / std::tan(height)),
               y = static_cast<float>(-std::sin(side) / std::tan(height));
    cv::Mat shade(slopes.x.size(), CV_32FC1);
    for (int row = 0; row < shade.rows; ++row) {
        const float *p = slopes.x.ptr<float>(row), *q = slopes.y.ptr<float>(row);
        float* to = shade.ptr<float>(row);
        for (int column = 0; column < shade.cols; ++column)
            to[column] =
                std::max(0.0f, 1 - p[column] * x - q[column] * y) / std::sqrt(1 + p[column] * p[column] + q[column] * q[column]);
    }
    return shade;
}

/// Factor at which at most `clippedShare` of the pixels is brighter than white.
float exposureOf(const cv::Mat& colour, const cv::Mat& shade, const Curves& curves)
{
    std::vector<int> counts(histogramBins);
    for (int row = 0; row < colour.rows; ++row)
        for (int column = 0; column < colour.cols; ++column) {
            const auto& pixel = colour.at<cv::Vec3b>(row, column);
            const float brightest = curves.linear[std::max({pixel[0], pixel[1], pixel[2]})] * shade.at<float>(row, column);
            ++counts[static_cast<std::size_t>(std::min(histogramBins - 1.0f, brightest * histogramBins / brightestShade))];
        }
    double clipped = 0;
    int bin = histogramBins - 1;
    while (bin > 0 && (clipped += counts[static_cast<std::size_t>(bin)]) <= clippedShare * double(colour.total())) --bin;
    return std::min(1.0f, histogramBins / (brightestShade * static_cast<float>(bin + 1)));
}

}  // namespace

cv::Mat relit(const Scan& scan, double sideDeg)
{
    static const Curves curves;
    const cv::Mat shade = shadeOf(scan.slopes, sideDeg);
    const float exposure = exposureOf(scan.colour, shade, curves);
    cv::Mat result(scan.colour.size(), CV_8UC3);
    const auto last = float(curves.stored.size() - 1);
    for (int row = 0; row < result.rows; ++row) {
        const auto* from = scan.colour.ptr<cv::Vec3b>(row);
        const float* light = shade.ptr<float>(row);
        auto* to = result.ptr<cv::Vec3b>(row);
        for (int column = 0; column < result.cols; ++column)
            for (int channel = 0; channel < 3; ++channel) {
                const float linear = curves.linear[from[column][channel]] * light[column] * exposure;
                to[column][channel] = curves.stored[static_cast<std::size_t>(std::min(last, linear * (last + 1)))];
            }
    }
    return result;
}

}  // namespace rendering::scans
