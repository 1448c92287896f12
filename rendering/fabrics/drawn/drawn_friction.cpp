#include "rendering/fabrics/drawn/drawn_friction.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "rendering/fabrics/drawn/cloth_window.h"

namespace rendering::fabrics {

namespace {

constexpr int feltPatchPx = 160;
constexpr double feltMm = 0.15;

}  // namespace

FrictionTerms visibleFriction(const DrawnFabric& fabric)
{
    const double pitch = std::clamp(threadPeriod(fabric).mm / 12, 0.03, 0.25);
    cv::Mat height = clothWindow(fabric, {37, 41, 0}, {feltPatchPx, feltPatchPx}, pitch, SlackShown::No).heightMm, slopeX, slopeY;
    cv::GaussianBlur(height, height, {}, feltMm / pitch);
    cv::Sobel(height, slopeX, CV_32F, 1, 0, 1, 1 / (2 * pitch));
    cv::Sobel(height, slopeY, CV_32F, 0, 1, 1, 1 / (2 * pitch));
    const double slope = std::sqrt(cv::mean(slopeX.mul(slopeX) + slopeY.mul(slopeY))[0]);
    return {fabric.adhesion * (1 - 0.6 * fabric.sheen) + 0.20 * fabric.hairiness, 1.5 * std::tanh(0.3 * slope)};
}

double meanFriction(const DrawnFabric& fabric, double forceN)
{
    return visibleFriction(fabric).sum() * fabric.unseen * std::pow(forceN / 15, -0.08);
}

ForceRecord strokeDrawn(const DrawnFabric& fabric, double mean, const FabricPlace& start, const FrictionRecording& recording,
                        protocols::Random& random)
{
    const auto relief = [&](const FabricPlace& centre, cv::Size size, double pitchMm) {
        return clothWindow(fabric, centre, size, pitchMm, SlackShown::No).heightMm;
    };
    return strokeRelief(relief, mean, start, recording, random);
}

std::string frictionLaw()
{
    return "mu = (A (1 - 0.6 sheen) + 1.5 tanh(0.3 s) + 0.20 hairiness) (F / 15 N)^-0.08, unseen spread " +
           std::to_string(std::lround(100 * unseenFrictionSpread)) + " %";
}

}  // namespace rendering::fabrics
