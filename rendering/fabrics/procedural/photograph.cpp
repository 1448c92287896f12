#include "rendering/fabrics/procedural/photograph.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "rendering/fabrics/procedural/picture_noise.h"

namespace rendering::fabrics {

namespace {

struct Lamp {
    float x, y, z;  ///< unit vector towards the lamp: x right, y down, z towards the camera
    float exposure;
    float whiteBalance[3];
};

Lamp drawLamp(protocols::Random& random)
{
    const double azimuth = (225 + random.uniform(-12, 12)) * std::numbers::pi / 180;  // From the upper left.
    const double elevation = (48 + random.uniform(-5, 5)) * std::numbers::pi / 180;
    Lamp lamp{float(std::cos(azimuth) * std::cos(elevation)),
              float(std::sin(azimuth) * std::cos(elevation)),
              float(std::sin(elevation)),
              float(random.uniform(0.92, 1.06)),
              {}};
    for (float& gain : lamp.whiteBalance) gain = float(random.uniform(0.985, 1.015));
    return lamp;
}

/// Loose fibres as short bent lines; their number grows with hairiness. Values 0 to 1.
cv::Mat looseFibres(cv::Size size, double hairiness, protocols::Random& random)
{
    cv::Mat fibres(size, CV_8UC1, cv::Scalar(0));
    const int count = int(hairiness * 260);
    for (int i = 0; i < count; ++i) {
        double x = random.uniform(0, size.width), y = random.uniform(0, size.height);
        double direction = random.uniform(0, 2 * std::numbers::pi);
        const double bend = random.uniform(-0.35, 0.35);
        const int strength = int(random.uniform(60, 200));
        std::vector<cv::Point> line;
        for (int step = 0; step < 6; ++step) {
            line.emplace_back(int(std::lround(x * 16)), int(std::lround(y * 16)));
            x += 3.2 * std::cos(direction);
            y += 3.2 * std::sin(direction);
            direction += bend;
        }
        cv::polylines(fibres, line, false, cv::Scalar(strength), 1, cv::LINE_AA, 4);
    }
    cv::Mat blurred;
    fibres.convertTo(blurred, CV_32F, 1.0 / 255);
    return blurred;
}

/// Reflected light per pixel, before the camera. A slight blur limits the slopes at the edges of yarns.
cv::Mat reflectedLight(const SurfacePatch& patch, const Structure& structure, const Lamp& lamp)
{
    cv::Mat smooth, surroundings, light(patch.heightMm.size(), CV_32FC1);
    cv::GaussianBlur(patch.heightMm, smooth, {}, 0.7);
    cv::GaussianBlur(patch.heightMm, surroundings, {}, 5);
    const float scale = float(1 / (2 * photographMmPerPixel));
    const float halfLength = std::sqrt(lamp.x * lamp.x + lamp.y * lamp.y + (lamp.z + 1) * (lamp.z + 1));
    const auto sheen = float(structure.sheen);
    for (int y = 0; y < smooth.rows; ++y) {
        const float* above = smooth.ptr<float>(std::max(y - 1, 0));
        const float* here = smooth.ptr<float>(y);
        const float* below = smooth.ptr<float>(std::min(y + 1, smooth.rows - 1));
        for (int x = 0; x < smooth.cols; ++x) {
            const float gx = (here[std::min(x + 1, smooth.cols - 1)] - here[std::max(x - 1, 0)]) * scale;
            const float gy = (below[x] - above[x]) * scale;
            const float length = std::sqrt(1 + gx * gx + gy * gy);
            const float lambert = std::max(0.f, (lamp.z - gx * lamp.x - gy * lamp.y) / length);
            const float towardsHalf = std::max(0.f, (lamp.z + 1 - gx * lamp.x - gy * lamp.y) / (length * halfLength));
            const float mirrored = std::pow(towardsHalf, 18.f);
            const float hollow = std::clamp(1 + 2.0f * (here[x] - surroundings.at<float>(y, x)), 0.45f, 1.15f);
            light.at<float>(y, x) = patch.shade.at<float>(y, x) * hollow * (0.30f + 0.62f * lambert) + 0.55f * sheen * mirrored;
        }
    }
    return light;
}

float vignetting(int x, int y, cv::Size size)
{
    const float dx = (float(x) - 0.5f * float(size.width)) / float(size.width),
                dy = (float(y) - 0.5f * float(size.height)) / float(size.height);
    return 1 - 0.16f * (dx * dx + dy * dy) * 2;
}

}  // namespace

cv::Mat photograph(const FabricSurface& surface, const FabricPlace& place, protocols::Random& random)
{
    const cv::Size size(photographSizePx, photographSizePx);
    const Structure& structure = surface.structure();
    const Lamp lamp = drawLamp(random);
    const SurfacePatch patch = surface.sample(place, size, photographMmPerPixel);
    cv::Mat light = reflectedLight(patch, structure, lamp);
    light += 0.16 * looseFibres(size, structure.hairiness, random);
    cv::GaussianBlur(light, light, {}, random.uniform(0.55, 0.75));
    NoiseSource noise(random.next());
    cv::Mat picture(size, CV_8UC3);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            const float arriving = light.at<float>(y, x) * vignetting(x, y, size) * lamp.exposure;
            cv::Vec3b& pixel = picture.at<cv::Vec3b>(y, x);
            for (int c = 0; c < 3; ++c) {
                const float linear = std::max(0.f, arriving * float(structure.colour[std::size_t(c)]) * lamp.whiteBalance[c]);
                const float grains = noise.next() * (0.004f + 0.008f * std::sqrt(linear));
                pixel[c] = cv::saturate_cast<uchar>(255 * std::pow(std::max(0.f, linear + grains), 1 / 2.2f));
            }
        }
    return picture;
}

}  // namespace rendering::fabrics
