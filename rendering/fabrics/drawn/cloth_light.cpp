#include "rendering/fabrics/drawn/cloth_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

namespace rendering::fabrics {

namespace {

constexpr int shadowSteps = 14;
constexpr int mirrorDoublings = 4;  // The mirrored light falls with the 16th power of the sine.

/// Normals and directions of the fibres, one plane each.
struct ClothShape {
    cv::Mat slopeX, slopeY;  ///< mm per mm
    cv::Mat hollow;          ///< 1 on top, directionOf 0 in hollows
};

cv::Mat boxBlur(const cv::Mat& map, double radius)
{
    cv::Mat smooth;
    const int size = 2 * std::max(1, int(std::lround(radius))) + 1;
    cv::boxFilter(map, smooth, CV_32F, {size, size}, {-1, -1}, true, cv::BORDER_REFLECT_101);
    return smooth;
}

/// How much of the sky a point sees: hollows of two sizes below their surroundings.
cv::Mat openness(const cv::Mat& heightMm, double pitchMm, double strength)
{
    cv::Mat open(heightMm.size(), CV_32FC1, cv::Scalar(1));
    const double reach = std::min(0.2 * heightMm.cols, 24.0);
    for (const double radius : {reach / 8, reach / 2}) {
        const cv::Mat around = boxBlur(heightMm, radius);
        const float scale = float(0.55 * strength / (radius * pitchMm));
        for (int y = 0; y < open.rows; ++y) {
            const float* here = heightMm.ptr<float>(y);
            const float* mean = around.ptr<float>(y);
            float* result = open.ptr<float>(y);
            for (int x = 0; x < open.cols; ++x) {
                const float below = std::max(0.f, (mean[x] - here[x]) * scale);
                const float above = std::min(0.25f, std::max(0.f, (here[x] - mean[x]) * scale));
                result[x] *= (1 + 0.4f * above) / (1 + 1.6f * below);
            }
        }
    }
    return open;
}

ClothShape shapeOf(const ClothWindow& window, double pitchMm, double occlusion)
{
    ClothShape shape;
    cv::Mat smooth;
    cv::GaussianBlur(window.heightMm, smooth, {5, 5}, 0.8);
    const cv::Mat kernel = (cv::Mat_<float>(1, 3) << -1, 0, 1) * (1 / (2 * pitchMm));
    cv::filter2D(smooth, shape.slopeX, CV_32F, kernel);
    cv::filter2D(smooth, shape.slopeY, CV_32F, kernel.t());
    shape.hollow = openness(window.heightMm, pitchMm, occlusion);
    return shape;
}

/// Light that reaches each point from the side of a lamp: 1 in the open, less in shadow.
cv::Mat unshadowed(const cv::Mat& heightMm, double pitchMm, const ClothLamp& lamp)
{
    double lowest = 0, highest = 0;
    cv::minMaxLoc(heightMm, &lowest, &highest);
    const double angle = lamp.azimuthDegrees * std::numbers::pi / 180,
                 climb = std::tan(lamp.elevationDegrees * std::numbers::pi / 180);
    const double reachPx = std::clamp((highest - lowest) / (climb * pitchMm), 1.0, 0.25 * heightMm.cols);
    cv::Mat above(heightMm.size(), CV_32FC1, cv::Scalar(-1));  // Tangent by which the ridge stands over the ray.
    int lastX = 0, lastY = 0;
    for (int step = 1; step <= shadowSteps; ++step) {
        const double distance = std::max(double(step), reachPx * std::pow(double(step) / shadowSteps, 1.5));
        if (distance > reachPx + 1) break;
        const int dx = int(std::lround(distance * std::cos(angle))), dy = int(std::lround(distance * std::sin(angle)));
        if (dx == lastX && dy == lastY) continue;
        lastX = dx;
        lastY = dy;
        const float inverse = float(1 / (std::hypot(dx, dy) * pitchMm)), offset = float(climb);
        const int left = std::max(0, -dx), right = heightMm.cols - std::max(0, dx);
        for (int y = std::max(0, -dy); y < heightMm.rows - std::max(0, dy); ++y) {
            const float* here = heightMm.ptr<float>(y);
            const float* there = heightMm.ptr<float>(y + dy) + dx;
            float* result = above.ptr<float>(y);
            for (int x = left; x < right; ++x) result[x] = std::max(result[x], (there[x] - here[x]) * inverse - offset);
        }
    }
    const float edge = float(0.08 + 0.6 * lamp.softness) * float(std::max(0.3, climb));
    for (float& value : cv::Mat_<float>(above)) value = 1 - std::clamp(0.5f + value / edge, 0.f, 1.f);
    return above;
}

struct LampDirection {
    float x, y, z;
};
LampDirection directionOf(const ClothLamp& lamp)
{
    const double azimuth = lamp.azimuthDegrees * std::numbers::pi / 180,
                 elevation = lamp.elevationDegrees * std::numbers::pi / 180;
    return {float(std::cos(azimuth) * std::cos(elevation)), float(std::sin(azimuth) * std::cos(elevation)),
            float(std::sin(elevation))};
}

/// Adds what one lamp contributes: `diffuse` is multiplied by the colour of the cloth later, `mirrored` is not.
void addLamp(cv::Mat& diffuse, cv::Mat& mirrored, const ClothWindow& window, const ClothShape& shape, const ClothLamp& lamp,
             double pitchMm, double widthPx)
{
    const cv::Mat open = unshadowed(window.heightMm, pitchMm, lamp);
    const LampDirection far = directionOf(lamp);
    const float perPixel = float(1 / (widthPx * lamp.distance)), strength = float(lamp.strength);
    const float wrap = float(0.12 + 0.25 * lamp.softness);
    const float centreX = 0.5f * float(diffuse.cols), centreY = 0.5f * float(diffuse.rows);
    for (int y = 0; y < diffuse.rows; ++y) {
        const float *slopeX = shape.slopeX.ptr<float>(y), *slopeY = shape.slopeY.ptr<float>(y), *lit = open.ptr<float>(y);
        const float *alongX = window.tangentX.ptr<float>(y), *alongY = window.tangentY.ptr<float>(y),
                    *alongZ = window.tangentZ.ptr<float>(y);
        float *sum = diffuse.ptr<float>(y), *glint = mirrored.ptr<float>(y);
        for (int x = 0; x < diffuse.cols; ++x) {
            // The direction to a near lamp changes over the picture, and so does its distance.
            const float lx = far.x - (float(x) - centreX) * perPixel, ly = far.y - (float(y) - centreY) * perPixel, lz = far.z;
            const float inverse2 = 1 / (lx * lx + ly * ly + lz * lz), inverse = std::sqrt(inverse2);
            const float light = strength * inverse2 * lit[x];
            const float normal = 1 / std::sqrt(1 + slopeX[x] * slopeX[x] + slopeY[x] * slopeY[x]);
            const float lambert = (lz - slopeX[x] * lx - slopeY[x] * ly) * normal * inverse;
            sum[x] += light * std::max(0.f, (lambert + wrap) / (1 + wrap));
            // Fibres mirror light onto a cone around their direction.
            const float hx = lx * inverse, hy = ly * inverse, hz = lz * inverse + 1;
            const float along = alongX[x] * hx + alongY[x] * hy + alongZ[x] * hz;
            const float towardsNormal = (hz - slopeX[x] * hx - slopeY[x] * hy) * normal;
            const float half2 = hx * hx + hy * hy + hz * hz;
            float sine2 = std::max(0.f, 1 - along * along / half2);
            for (int k = 0; k < mirrorDoublings; ++k) sine2 *= sine2;
            const float facing = towardsNormal * towardsNormal / half2;
            glint[x] += light * sine2 * facing * facing * facing * std::max(0.f, lambert + 0.2f);
        }
    }
}

}  // namespace

cv::Mat reflectedLight(const ClothWindow& window, double sheen, double pitchMm, int borderPx, const ClothCamera& camera)
{
    const cv::Size size = window.heightMm.size();
    const ClothShape shape = shapeOf(window, pitchMm, camera.occlusion);
    cv::Mat result(size, CV_32FC3), diffuse(size, CV_32FC1), mirrored(size, CV_32FC1);
    result.setTo(cv::Scalar::all(0));
    const double widthPx = size.width - 2 * borderPx;
    double total = camera.ambient;
    for (const ClothLamp& lamp : camera.lamps) total += lamp.strength * std::sin(lamp.elevationDegrees * std::numbers::pi / 180);
    const float full = float(1 / total);
    const auto gloss = float(0.9 * sheen * camera.gloss);
    cv::Mat glow;
    const auto add = [&](const float tint[3], float ambient, bool isLamp) {
        for (int y = 0; y < size.height; ++y) {
            const float *hollow = shape.hollow.ptr<float>(y), *colour = window.colour.ptr<float>(y);
            const float *sum = isLamp ? diffuse.ptr<float>(y) : nullptr, *glint = isLamp ? mirrored.ptr<float>(y) : nullptr;
            const float* spread = isLamp && !glow.empty() ? glow.ptr<float>(y) : nullptr;
            const float* cover = window.cover.ptr<float>(y);
            float* out = result.ptr<float>(y);
            for (int x = 0; x < size.width; ++x) {
                const float matte =
                    full * hollow[x] *
                    (isLamp ? (spread != nullptr ? sum[x] + float(camera.glow) * (spread[x] - sum[x]) : sum[x]) : ambient);
                const float shine = isLamp ? full * gloss * cover[x] * glint[x] : 0;
                for (int c = 0; c < 3; ++c)
                    out[3 * x + c] += tint[c] * (matte * colour[3 * x + c] + shine * (0.35f + 0.65f * colour[3 * x + c]));
            }
        }
    };
    static constexpr float white[3] = {1, 1, 1};
    add(white, float(camera.ambient), false);
    for (const ClothLamp& lamp : camera.lamps) {
        diffuse.setTo(0);
        mirrored.setTo(0);
        addLamp(diffuse, mirrored, window, shape, lamp, pitchMm, widthPx);
        if (camera.glow > 0) glow = boxBlur(diffuse, std::max(1.0, 0.06 / pitchMm));
        add(lamp.tint, 0, true);
    }
    return result;
}

}  // namespace rendering::fabrics
