#include "rendering/fabrics/drawn/cloth_camera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "rendering/fabrics/drawn/cloth_light.h"
#include "rendering/fabrics/drawn/jpeg_loss.h"
#include "rendering/fabrics/procedural/picture_noise.h"

namespace rendering::fabrics {

namespace {

using protocols::Random;

constexpr double finePixelsPerThread = 6;
constexpr int finestFactor = 3;
constexpr int toneSteps = 4096;
constexpr double usualLampShare = 0.5, upperLeftDegrees = 225;  // from x to y, which points down

bool happens(Random& random, double share) { return random.uniform() < share; }

ClothLamp drawClothLamp(Random& random)
{
    ClothLamp lamp;
    if (happens(random, usualLampShare)) {
        lamp.azimuthDegrees = upperLeftDegrees + 15 * random.normal();
        lamp.elevationDegrees = random.uniform(15, 50);
    } else {
        lamp.azimuthDegrees = random.uniform(0, 360);
        lamp.elevationDegrees = 10 + 75 * std::pow(random.uniform(), 0.8);
    }
    lamp.strength = random.uniform(0.3, 1);
    lamp.distance = 1.2 * std::exp(random.uniform() * std::log(20.0));
    lamp.softness = random.uniform();
    const double warm = 0.06 * random.normal();
    lamp.tint[0] = float(std::clamp(1 + warm, 0.8, 1.2));
    lamp.tint[2] = float(std::clamp(1 - warm, 0.8, 1.2));
    return lamp;
}

/// Factor by which the cloth is sampled more finely than the picture.
int finenessFor(const DrawnFabric& fabric, double mmPerPixel)
{
    const double thread = std::min(fabric.warp.spacingMm, fabric.weft.spacingMm);
    const bool piled = fabric.kind == ClothKind::CutPile || fabric.kind == ClothKind::Fleece;
    const double shown = (piled ? 2 * fabric.pile.widthMm : thread) / mmPerPixel;
    return std::clamp(int(std::lround(finePixelsPerThread / shown)), 1, finestFactor);
}

/// Loose fibres over the picture, 0 to 1. They lie at fixed cells of the window only, so they differ between photographs.
void addLooseFibres(cv::Mat& light, double hairiness, double pitchMm, Random& random)
{
    const double areaMm2 = double(light.total()) * pitchMm * pitchMm;
    const int count = int(std::min(260.0, areaMm2 * 5 * hairiness * hairiness));
    if (count < 1) return;
    cv::Mat fibres(light.size(), CV_8UC1, cv::Scalar(0)), soft;
    std::vector<cv::Point> line;
    for (int i = 0; i < count; ++i) {
        double x = random.uniform(0, light.cols), y = random.uniform(0, light.rows),
               direction = random.uniform(0, 2 * std::numbers::pi);
        const double bend = random.uniform(-0.5, 0.5), step = random.uniform(0.05, 0.25) / pitchMm;
        const double thin = std::min(1.0, 0.025 / pitchMm);  // A fibre narrower than a pixel covers a part of it.
        const int strength = int(255 * thin * random.uniform(0.3, 0.9));
        line.clear();
        for (int k = 0; k < 7; ++k) {
            line.emplace_back(int(std::lround(x * 16)), int(std::lround(y * 16)));
            x += step * std::cos(direction);
            y += step * std::sin(direction);
            direction += bend;
        }
        cv::polylines(fibres, line, false, cv::Scalar(strength), 1, cv::LINE_AA, 4);
    }
    cv::boxFilter(light, soft, CV_32F, {9, 9});
    for (int y = 0; y < light.rows; ++y) {
        const uchar* mask = fibres.ptr<uchar>(y);
        float* out = light.ptr<float>(y);
        const float* around = soft.ptr<float>(y);
        for (int x = 0; x < light.cols; ++x)
            if (mask[x] != 0)
                for (int c = 0; c < 3; ++c)
                    out[3 * x + c] += float(mask[x]) / 255 * (1.25f * around[3 * x + c] + 0.01f - out[3 * x + c]);
    }
}

void blur(cv::Mat& light, const ClothCamera& camera)
{
    if (camera.defocusPx > 0.2) {
        const int size = 2 * int(std::ceil(2.5 * camera.defocusPx)) + 1;
        cv::GaussianBlur(light, light, {size, size}, camera.defocusPx);
    }
    if (camera.motionPx < 0.5) return;
    const int size = 2 * int(std::ceil(camera.motionPx / 2)) + 1, middle = size / 2;
    cv::Mat kernel(size, size, CV_32FC1, cv::Scalar(0));
    const double angle = camera.motionDegrees * std::numbers::pi / 180;
    const double dx = 0.5 * camera.motionPx * std::cos(angle) * 16, dy = 0.5 * camera.motionPx * std::sin(angle) * 16;
    cv::line(kernel, {int(std::lround(middle * 16 - dx)), int(std::lround(middle * 16 - dy))},
             {int(std::lround(middle * 16 + dx)), int(std::lround(middle * 16 + dy))}, cv::Scalar(1), 1, cv::LINE_8, 4);
    kernel /= cv::sum(kernel)[0];
    cv::filter2D(light, light, CV_32F, kernel);
}

std::vector<float> toneCurve(const ClothCamera& camera)
{
    std::vector<float> curve(toneSteps + 1);
    for (int i = 0; i <= toneSteps; ++i) {
        const double value = std::pow(double(i) / toneSteps, 1 / camera.gamma);
        const double bent = value * value * (3 - 2 * value);
        curve[std::size_t(i)] = float(255 * (value + camera.contrast * (bent - value)));
    }
    return curve;
}

/// Factor that brings the mean of the picture to an ordinary exposure. Dark cloth stays darker than pale cloth.
float exposureFor(const cv::Mat& light, const ClothCamera& camera)
{
    const cv::Scalar mean = cv::mean(light);
    const double grey = std::max(1e-4, (mean[0] + 2 * mean[1] + mean[2]) / 4);
    return float(camera.exposure * std::pow(0.25 / grey, 0.55));
}

cv::Mat develop(const cv::Mat& light, float exposure, const ClothCamera& camera, std::uint64_t noiseSeed)
{
    const std::vector<float> tones = toneCurve(camera);
    NoiseSource noise(noiseSeed);
    cv::Mat values(light.size(), CV_32FC3);
    const float corner = float(2 * camera.vignetting / double(light.cols * light.cols + light.rows * light.rows) * 2);
    const auto photon = float(camera.photonNoise), read = float(camera.readNoise);
    for (int y = 0; y < light.rows; ++y) {
        const float* in = light.ptr<float>(y);
        float* out = values.ptr<float>(y);
        const float dy = float(y) - 0.5f * float(light.rows);
        for (int x = 0; x < light.cols; ++x) {
            const float dx = float(x) - 0.5f * float(light.cols);
            const float gain = exposure * (1 - corner * (dx * dx + dy * dy));
            const float grain = noise.next();
            for (int c = 0; c < 3; ++c) {
                const float linear = std::max(0.f, in[3 * x + c] * gain * camera.whiteBalance[c]);
                // Grain of the three channels is partly common, as demosaicing leaves it.
                const float noisy = linear + (0.6f * grain + 0.8f * noise.next()) * (read + photon * std::sqrt(linear));
                out[3 * x + c] = tones[std::size_t(std::clamp(noisy, 0.f, 1.f) * toneSteps)];
            }
        }
    }
    if (camera.sharpening > 0.02) {
        cv::Mat soft;
        cv::GaussianBlur(values, soft, {5, 5}, 1.0);
        values += camera.sharpening * (values - soft);
    }
    cv::Mat rgb;
    values.convertTo(rgb, CV_8U);
    return rgb;
}

/// What the camera makes of the light inside its picture.
ClothPhotograph developed(cv::Mat& light, const cv::Mat& heightMm, const cv::Rect& inside, const ClothCamera& camera,
                          Random& random)
{
    blur(light, camera);
    const cv::Mat seen = light(inside);
    ClothPhotograph result;
    result.rgb = develop(seen, exposureFor(seen, camera), camera, random.next());
    if (camera.jpegQuality > 0) result.rgb = afterJpeg(result.rgb, camera.jpegQuality);
    result.heightMm = heightMm(inside).clone();
    return result;
}

}  // namespace

ClothCamera drawCamera(bool isFlat, Random& random)
{
    ClothCamera camera;
    camera.isFlat = isFlat;
    const int lamps = isFlat ? 0 : happens(random, 0.55) ? 1 : 1 + int(random.below(4));
    for (int i = 0; i < lamps; ++i) camera.lamps.push_back(drawClothLamp(random));
    const bool isRelit = !isFlat && happens(random, 0.25);
    camera.ambient = isFlat ? 1 : isRelit ? random.uniform(0, 0.1) : random.uniform(0.05, 1.0);
    camera.occlusion = isFlat || isRelit ? 1.5 * random.uniform() * random.uniform() : random.uniform(0.3, 1.2);
    camera.glow = isRelit ? 0 : random.uniform(0.1, 0.6);
    camera.gloss = isFlat || isRelit ? 0 : random.uniform(0.5, 1.3);
    if (isRelit)
        for (ClothLamp& lamp : camera.lamps) {
            lamp.distance = 30;
            lamp.softness = 0;
        }
    camera.exposure = std::exp((isFlat ? 0.1 : 0.3) * random.normal());
    for (float& gain : camera.whiteBalance) gain = float(std::exp((isFlat ? 0.02 : 0.08) * random.normal()));
    camera.gamma = isFlat ? 2.2 : random.uniform(1.8, 2.5);
    camera.contrast = isFlat ? 0 : random.uniform(-0.1, 0.45);
    camera.vignetting = isFlat ? 0 : 0.45 * random.uniform() * random.uniform();
    camera.defocusPx = happens(random, 0.15) ? random.uniform(1.0, 2.2) : random.uniform(0.2, 0.9);
    camera.motionPx = !isFlat && happens(random, 0.1) ? random.uniform(0.8, 4) : 0;
    camera.motionDegrees = random.uniform(0, 180);
    camera.photonNoise = 0.002 * std::exp(random.uniform() * std::log(isFlat ? 4.0 : 15.0));
    camera.readNoise = 0.0005 * std::exp(random.uniform() * std::log(isFlat ? 4.0 : 16.0));
    camera.sharpening = happens(random, 0.4) ? random.uniform(0.1, 1.0) : 0;
    camera.jpegQuality = happens(random, 0.75) ? 45 + int(random.below(54)) : 0;
    return camera;
}

std::optional<double> lightSide(const ClothCamera& camera)
{
    if (camera.lamps.size() != 1) return std::nullopt;
    // Azimuths run clockwise in the picture, because y points down.
    return std::fmod(std::fmod(360 - camera.lamps.front().azimuthDegrees, 360) + 360, 360);
}

ClothPhotograph photographCloth(const DrawnFabric& fabric, const FabricPlace& place, cv::Size size, double mmPerPixel,
                                const ClothCamera& camera, Random& random)
{
    const int fineness = finenessFor(fabric, mmPerPixel);
    const int border = 6 + int(std::ceil(camera.motionPx / 2));
    const cv::Size whole(size.width + 2 * border, size.height + 2 * border);
    const double finePitch = mmPerPixel / fineness;
    const ClothWindow window = clothWindow(fabric, place, whole * fineness, finePitch);
    cv::Mat light = reflectedLight(window, fabric.sheen, finePitch, border * fineness, camera);
    addLooseFibres(light, fabric.hairiness, finePitch, random);
    cv::Mat height = window.heightMm;
    if (fineness > 1) {
        cv::resize(light, light, whole, 0, 0, cv::INTER_AREA);
        cv::resize(height, height, whole, 0, 0, cv::INTER_AREA);
    }
    ClothPhotograph result = developed(light, height, cv::Rect(border, border, size.width, size.height), camera, random);
    result.textureSqMm = window.textureSqMm;
    return result;
}

ClothWindow windowOf(const cv::Mat& heightMm, const cv::Mat& reflectance)
{
    const cv::Mat none = cv::Mat::zeros(heightMm.size(), CV_32F), all = cv::Mat::ones(heightMm.size(), CV_32F);
    cv::Scalar mean, deviation;
    cv::meanStdDev(heightMm, mean, deviation);
    return {heightMm, none, none, none, reflectance, all, deviation[0]};
}

ClothPhotograph photographWindow(const ClothWindow& window, double mmPerPixel, int border, const ClothCamera& camera,
                                 Random& random)
{
    cv::Mat light = reflectedLight(window, 0, mmPerPixel, border, camera);
    const cv::Size size = window.heightMm.size();
    ClothPhotograph result =
        developed(light, window.heightMm, {border, border, size.width - 2 * border, size.height - 2 * border}, camera, random);
    result.textureSqMm = window.textureSqMm;
    return result;
}

}  // namespace rendering::fabrics
