#include "rendering/signals/tactile/photometric_stereo.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "protocols/files/errors.h"

namespace rendering::signals {

namespace {

constexpr int contourLevels = 64;
constexpr double nearlyStrongest = 0.99;  ///< of the strongest level; so much the noise of a frame changes it
constexpr float flattestNormal = 0.02F;   ///< nz; larger slopes than 1 / 0.02 come from rounding

/// Value that `percent` of the pixels do not exceed.
double percentile(const cv::Mat& values, double percent)
{
    std::vector<float> sorted(values.begin<float>(), values.end<float>());
    const auto place = static_cast<std::ptrdiff_t>(std::floor(percent / 100 * static_cast<double>(sorted.size() - 1)));
    std::nth_element(sorted.begin(), sorted.begin() + place, sorted.end());
    return sorted[static_cast<std::size_t>(place)];
}

/// Norm of the light over its channels.
cv::Mat strengthOf(const cv::Mat& light)
{
    cv::Mat squares = light.mul(light), strength;
    cv::reduce(squares.reshape(1, static_cast<int>(light.total())), strength, 1, cv::REDUCE_SUM);
    cv::sqrt(strength.reshape(1, light.rows), strength);
    return strength;
}

/// Mean strength of the pixels between neighbouring levels of height; 0 for levels without pixels.
std::array<double, contourLevels> strengthByLevel(const cv::Mat& height, const cv::Mat& strength, double top)
{
    std::array<double, contourLevels> sum{}, count{};
    for (int i = 0; i < height.rows; ++i)
        for (int j = 0; j < height.cols; ++j) {
            const int level = static_cast<int>(contourLevels * height.at<float>(i, j) / top);
            if (level < 0 || level >= contourLevels) continue;
            sum[static_cast<std::size_t>(level)] += strength.at<float>(i, j);
            count[static_cast<std::size_t>(level)] += 1;
        }
    for (std::size_t level = 0; level < contourLevels; ++level) sum[level] = count[level] > 0 ? sum[level] / count[level] : 0;
    return sum;
}

/// Levels are shares of the height.
struct EdgeLevel {
    double level = 0.5;
    double halfWidth = 0;  ///< of the levels that are nearly as strong
};

/// Level between a tenth and nine tenths of the height with the largest strength, summed over five levels.
EdgeLevel edgeLevel(const std::array<double, contourLevels>& strength)
{
    constexpr std::size_t first = contourLevels / 10, last = contourLevels * 9 / 10;
    std::array<double, contourLevels> around{};
    for (std::size_t level = first; level < last; ++level)
        for (std::size_t k = level - 2; k <= level + 2; ++k) around[level] += strength[k];
    const auto most = std::max_element(around.begin() + first, around.begin() + last);
    const auto isNear = [&](double some) { return some >= nearlyStrongest * *most; };
    auto low = most, high = most;
    while (low > around.begin() + first && isNear(*(low - 1))) --low;
    while (high + 1 < around.begin() + last && isNear(*(high + 1))) ++high;
    return {(static_cast<double>(most - around.begin()) + 0.5) / contourLevels,
            (static_cast<double>(high - low) + 1) / (2 * contourLevels)};
}

}  // namespace

Slopes slopesFromFrame(const cv::Mat& frame, const cv::Mat& reference, const Calibration& calibration)
{
    if (!frame.empty() && frame.channels() != calibration.channels)
        throw protocols::badInput({.what = "the tactile frame has " + std::to_string(frame.channels()) + " channels",
                                   .where = "",
                                   .expected = std::to_string(calibration.channels) + " channels, like the calibration",
                                   .nextStep = "use the calibration of this sensor"});
    return slopesOf(calibration.map, lightOf(frame, reference, calibration.light));
}

cv::Mat zeroedRelief(const cv::Mat& heightMm, const Pitch& pitch, std::optional<double> highPassCutoffMm, double zeroPercentile)
{
    const cv::Mat relief = highPassCutoffMm ? withoutLowFrequency(heightMm, pitch, *highPassCutoffMm) : heightMm;
    cv::Mat height;
    relief.convertTo(height, CV_32F);
    if (!cv::checkRange(height))
        throw protocols::badInput({.what = "the height map holds values that are not finite",
                                   .where = "",
                                   .expected = "a number in every pixel",
                                   .nextStep = "check the map, the calibration or the model that it comes from"});
    height -= percentile(height, zeroPercentile);
    height.setTo(0, height <= 0);  // std::max would keep -0.
    return height;
}

cv::Mat heightFromFrame(const cv::Mat& frame, const cv::Mat& reference, const Calibration& calibration,
                        IntegrationQuality quality)
{
    const Pitch pitch{calibration.mmPerPixel, calibration.mmPerPixel};
    const cv::Mat height = integrate(slopesFromFrame(frame, reference, calibration), pitch, SlopeKind::Point, quality);
    return zeroedRelief(height, pitch, calibration.highPassCutoffMm, calibration.zeroPercentile);
}

bool hasOutside(const cv::Mat& light)
{
    cv::Mat strength = strengthOf(light);
    cv::blur(strength, strength, {3, 3});
    const double strongest = percentile(strength, 99.5);
    return strongest > 0.1 && cv::countNonZero(strength < 0.25 * strongest) > 0.6 * static_cast<double>(strength.total());
}

Contact contactOf(const cv::Mat& gelHeightMm, const cv::Mat& light)
{
    cv::Mat height;
    gelHeightMm.convertTo(height, CV_32F);
    cv::GaussianBlur(height, height, {}, 1);
    const double top = percentile(height, 99.9);
    if (!(top > 0)) return {cv::Mat::zeros(height.size(), CV_8UC1), 0};
    const auto edge = edgeLevel(strengthByLevel(height, strengthOf(light), top));
    return {height > top * edge.level, top * edge.halfWidth};
}

cv::Mat heightInContact(const Slopes& slopes, const cv::Mat& contact, const Pitch& pitch, IntegrationQuality quality)
{
    Slopes inside{slopes.x.clone(), slopes.y.clone()};
    inside.x.setTo(0, contact == 0);
    inside.y.setTo(0, contact == 0);
    cv::Mat height;
    integrate(inside, pitch, SlopeKind::Point, quality).convertTo(height, CV_32F);
    const cv::Mat outside = contact == 0;
    if (cv::countNonZero(outside) > 0) height -= cv::mean(height, outside)[0];
    height.setTo(0, outside);
    return cv::max(height, 0);
}

Slopes slopesFromNormals(const cv::Mat& image)
{
    if (image.empty() || (image.type() != CV_8UC3 && image.type() != CV_16UC3))
        throw protocols::badInput({.what = "the image is not a normal map",
                                   .where = "",
                                   .expected = "an RGB image of 8 or 16 bits",
                                   .nextStep = "export the normal map as RGB"});
    cv::Mat normals;
    image.convertTo(normals, CV_32F, 2.0 / (image.depth() == CV_16U ? 65535 : 255), -1);
    Slopes slopes{cv::Mat(image.size(), CV_32FC1), cv::Mat(image.size(), CV_32FC1)};
    for (int i = 0; i < normals.rows; ++i) {
        const auto* normal = normals.ptr<cv::Vec3f>(i);
        float *x = slopes.x.ptr<float>(i), *y = slopes.y.ptr<float>(i);
        for (int j = 0; j < normals.cols; ++j) {
            const bool seen = normal[j][2] > flattestNormal;
            x[j] = seen ? -normal[j][0] / normal[j][2] : std::numeric_limits<float>::quiet_NaN();
            y[j] = seen ? normal[j][1] / normal[j][2] : std::numeric_limits<float>::quiet_NaN();
        }
    }
    return slopes;
}

}  // namespace rendering::signals
