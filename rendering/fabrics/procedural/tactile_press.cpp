#include "rendering/fabrics/procedural/tactile_press.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "rendering/fabrics/procedural/picture_noise.h"

namespace rendering::fabrics {

namespace {

constexpr double gelSigmaMm = 0.075;
constexpr float contactSoftnessMm = 0.03f;
constexpr float heightStep = 1.0f / 8192;
constexpr double lampGain = 0.33;                     // Change of a channel (share of full scale) per unit slope along its lamp.
constexpr double lampAzimuthDeg[3] = {90, 210, 330};  // Red below, green upper left, blue upper right (y down).
constexpr float linearUpTo = 0.26f;                   // Saturation begins at this share of full scale.
constexpr float saturatesAt = 0.42f;
constexpr float frameNoise = 0.8f;  // Standard deviation in 8-bit steps.

struct GelSlopes {
    cv::Mat x, y;  ///< mm per mm
};

GelSlopes centralSlopes(const cv::Mat& heightMm)
{
    GelSlopes slopes;
    const cv::Mat kernelX = (cv::Mat_<float>(1, 3) << -1, 0, 1);
    cv::filter2D(heightMm, slopes.x, CV_32F, kernelX, {-1, -1}, 0, cv::BORDER_REFLECT_101);
    cv::filter2D(heightMm, slopes.y, CV_32F, kernelX.t(), {-1, -1}, 0, cv::BORDER_REFLECT_101);
    slopes.x *= 1 / (2 * tactileMmPerPixel);
    slopes.y *= 1 / (2 * tactileMmPerPixel);
    return slopes;
}

float saturated(float change)
{
    const float size = std::abs(change);
    if (size <= linearUpTo) return change;
    const float room = saturatesAt - linearUpTo;
    return std::copysign(linearUpTo + room * std::tanh((size - linearUpTo) / room), change);
}

/// Light of the untouched gel in 8-bit steps: brighter on each lamp's side, darker in the corners.
float referenceLight(int channel, int x, int y)
{
    const double angle = lampAzimuthDeg[channel] * std::numbers::pi / 180;
    const double dx = (x - 0.5 * tactileWidthPx) / (0.5 * tactileHeightPx),
                 dy = (y - 0.5 * tactileHeightPx) / (0.5 * tactileHeightPx);
    static constexpr double levels[3] = {116, 122, 127};
    return float(levels[channel] + 9 * (std::cos(angle) * dx + std::sin(angle) * dy) - 4 * (dx * dx + dy * dy));
}

/// Row of K for one channel: its change per unit slope in x and in y.
struct LampRow {
    float x, y;
};
LampRow lampRow(int channel)
{
    const double angle = lampAzimuthDeg[channel] * std::numbers::pi / 180;
    return {float(-lampGain * std::cos(angle)), float(-lampGain * std::sin(angle))};
}

float percentileOf(const cv::Mat& values, double percent)
{
    std::vector<float> sorted(values.begin<float>(), values.end<float>());
    const auto place = std::ptrdiff_t(std::lround(percent / 100 * double(sorted.size() - 1)));
    std::nth_element(sorted.begin(), sorted.begin() + place, sorted.end());
    return sorted[std::size_t(place)];
}

/// Indentation of the gel by a surface that reaches `depthMm` below its highest yarns, mm.
cv::Mat indentation(const cv::Mat& surfaceMm, double depthMm)
{
    const float bottom = percentileOf(surfaceMm, 99) - float(depthMm);
    cv::Mat followed(surfaceMm.size(), CV_32FC1);
    for (int y = 0; y < surfaceMm.rows; ++y)
        for (int x = 0; x < surfaceMm.cols; ++x) {
            const float over = (surfaceMm.at<float>(y, x) - bottom) / contactSoftnessMm;
            followed.at<float>(y, x) = over > 12 ? contactSoftnessMm * over : contactSoftnessMm * std::log1p(std::exp(over));
        }
    cv::GaussianBlur(followed, followed, {}, gelSigmaMm / tactileMmPerPixel);
    double lowest = 0;
    cv::minMaxLoc(followed, &lowest);
    for (float& height : cv::Mat_<float>(followed)) height = std::round((height - float(lowest)) / heightStep) * heightStep;
    return followed;
}

}  // namespace

Press pressSensor(const FabricSurface& surface, const FabricPlace& place, protocols::Random& random)
{
    return pressSurface(surface.sample(place, {tactileWidthPx, tactileHeightPx}, tactileMmPerPixel).heightMm, random);
}

Press pressSurface(const cv::Mat& surfaceMm, protocols::Random& random)
{
    Press press;
    press.heightMm = indentation(surfaceMm, random.uniform(0.46, 0.54));
    press.frame = tactileFrame(press.heightMm, random);
    return press;
}

cv::Mat tactileFrame(const cv::Mat& heightMm, protocols::Random& random)
{
    const GelSlopes slopes = centralSlopes(heightMm);
    NoiseSource noise(random.next());
    cv::Mat frame(heightMm.size(), CV_8UC3);
    for (int c = 0; c < 3; ++c) {
        const LampRow lamp = lampRow(c);
        for (int y = 0; y < frame.rows; ++y)
            for (int x = 0; x < frame.cols; ++x) {
                const float change = saturated(lamp.x * slopes.x.at<float>(y, x) + lamp.y * slopes.y.at<float>(y, x));
                const float light = referenceLight(c, x, y) + 255 * change + frameNoise * noise.next();
                frame.at<cv::Vec3b>(y, x)[c] = cv::saturate_cast<uchar>(light);
            }
    }
    return frame;
}

cv::Mat tactileReference()
{
    cv::Mat frame(tactileHeightPx, tactileWidthPx, CV_8UC3);
    for (int y = 0; y < frame.rows; ++y)
        for (int x = 0; x < frame.cols; ++x)
            for (int c = 0; c < 3; ++c) frame.at<cv::Vec3b>(y, x)[c] = cv::saturate_cast<uchar>(referenceLight(c, x, y));
    return frame;
}

std::string tactileCalibrationJson()
{
    // Three lamps at 120 degrees: K^T K = 1.5 gain^2 I, so the least-squares inverse of K is K^T / (1.5 gain^2).
    nlohmann::ordered_json gradient = {nlohmann::json::array(), nlohmann::json::array()};
    for (int c = 0; c < 3; ++c) {
        const double angle = lampAzimuthDeg[c] * std::numbers::pi / 180;
        gradient[0].push_back(-std::cos(angle) / (1.5 * lampGain));
        gradient[1].push_back(-std::sin(angle) / (1.5 * lampGain));
    }
    const nlohmann::ordered_json calibration = {{"schema", "vis2hap.calibration/1"},
                                                {"kind", "linear"},
                                                {"gradient_from_rgb", gradient},
                                                {"offset", {0.0, 0.0}},
                                                {"mm_per_pixel", tactileMmPerPixel},
                                                {"high_pass_cutoff_mm", 4.0},
                                                {"zero_percentile", 1.0}};
    return calibration.dump(2) + "\n";
}

}  // namespace rendering::fabrics
