#include "rendering/models/photograph_at_pitch.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "rendering/signals/dominant_wave.h"

namespace rendering::models {

namespace {

/// What is taken of one side: its pixels in the photograph and how many they become.
struct Side {
    int from = 0, length = 0, becomes = 0;
};

Side shownOf(int length, double factor)
{
    const double whole = std::max(1.0, std::round(length * factor));
    if (whole <= largestSidePx) return {0, length, static_cast<int>(whole)};
    const int taken = std::clamp(static_cast<int>(std::lround(largestSidePx / factor)), 1, length);
    return {(length - taken) / 2, taken, largestSidePx};
}

/// Of the procedural fabrics at 0.05 mm a pixel: the finest (a silk satin) has a period of 5 px, most have 7 to 11.
constexpr double finestPeriodPx = 5, ordinaryPeriodPx = 9;
/// Finer waves than 2.3 px are hardly resolved; more enlargement would show nothing new.
constexpr double mostEnlargement = 4;

}  // namespace

double assumedMmPerPixel(const cv::Mat& rgb, double modelMmPerPixel)
{
    const auto wave = signals::dominantWave(rgb);
    return wave && wave->periodPx < finestPeriodPx
               ? modelMmPerPixel * std::min(mostEnlargement, ordinaryPeriodPx / wave->periodPx)
               : modelMmPerPixel;
}

cv::Mat evenlyLit(const cv::Mat& rgb)
{
    // Blurred on a small copy: a falling off has no details.
    constexpr double sigmaPx = 64, shrink = 8;
    cv::Mat grey, small, light, lit;
    cv::cvtColor(rgb, grey, cv::COLOR_RGB2GRAY);
    const cv::Size size(std::max(1, static_cast<int>(rgb.cols / shrink)), std::max(1, static_cast<int>(rgb.rows / shrink)));
    cv::resize(grey, small, size, 0, 0, cv::INTER_AREA);
    small.convertTo(small, CV_32F);
    cv::GaussianBlur(small, small, {}, sigmaPx / shrink);
    cv::resize(cv::max(small, 1), light, rgb.size(), 0, 0, cv::INTER_CUBIC);
    cv::Mat share = cv::mean(grey)[0] / cv::max(light, 1), shares;
    cv::merge(std::vector<cv::Mat>{share, share, share}, shares);
    cv::multiply(rgb, shares, lit, 1, CV_8U);
    return lit;
}

SeenPhotograph photographAtPitch(const PhotographToTouch& photograph, double mmPerPixel)
{
    const double factor = photograph.mmPerPixel.value_or(mmPerPixel) / mmPerPixel;
    const Side across = shownOf(photograph.photograph.cols, factor), down = shownOf(photograph.photograph.rows, factor);
    const cv::Mat shown = photograph.photograph({across.from, down.from, across.length, down.length});
    const cv::Size size(across.becomes, down.becomes);
    SeenPhotograph seen;
    seen.part = {across.from, down.from, across.length, down.length};
    seen.middleOnly = shown.size() != photograph.photograph.size();
    if (size == shown.size())
        seen.rgb = shown.clone();
    else
        cv::resize(shown, seen.rgb, size, 0, 0, factor < 1 ? cv::INTER_AREA : cv::INTER_CUBIC);
    return seen;
}

}  // namespace rendering::models
