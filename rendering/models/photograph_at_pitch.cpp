#include "rendering/models/photograph_at_pitch.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "rendering/signals/dominant_wave.h"

namespace rendering::models {

namespace {

/// One side of the used part: pixels in the photograph, and pixels after scaling.
struct UsedSide {
    int from = 0, length = 0, becomes = 0;
};

UsedSide usedSide(int length, double factor)
{
    const double whole = std::max(1.0, std::round(length * factor));
    if (whole <= largestSidePx) return {0, length, static_cast<int>(whole)};
    const int taken = std::clamp(static_cast<int>(std::lround(largestSidePx / factor)), 1, length);
    return {(length - taken) / 2, taken, largestSidePx};
}

/// Most procedural fabrics have periods of 7 to 11 px at 0.05 mm per pixel.
constexpr double ordinaryPeriodPx = 9;
/// Spacing of the threads of ordinary clothing.
constexpr double ordinaryThreadMm = 0.45;
/// Closest yarns of drawn fabrics (drawn_fabric.h).
constexpr double finestYarnMm = 0.15;
/// Waves below 2.3 px are hardly resolved, so more enlargement would add nothing.
constexpr double mostEnlargement = 4;

}  // namespace

double assumedMmPerPixel(const cv::Mat& rgb, const Architecture& architecture)
{
    const UsedSide across = usedSide(rgb.cols, 1), down = usedSide(rgb.rows, 1);
    const auto wave = signals::dominantWave(rgb({across.from, down.from, across.length, down.length}));
    if (architecture.sees) return ordinaryThreadMm / (wave ? wave->periodPx : ordinaryPeriodPx);
    return wave && wave->periodPx < finestPeriodPx
               ? architecture.mmPerPixel * std::min(mostEnlargement, ordinaryPeriodPx / wave->periodPx)
               : architecture.mmPerPixel;
}

double finestWeaveMm(const Architecture& architecture)
{
    return architecture.sees ? finestYarnMm : finestPeriodPx * architecture.mmPerPixel;
}

PhotographAtPitch photographAtPitch(const InputPhotograph& photograph, double mmPerPixel)
{
    const double factor = photograph.mmPerPixel.value_or(mmPerPixel) / mmPerPixel;
    const UsedSide across = usedSide(photograph.photograph.cols, factor), down = usedSide(photograph.photograph.rows, factor);
    const cv::Mat shown = photograph.photograph({across.from, down.from, across.length, down.length});
    const cv::Size size(across.becomes, down.becomes);
    PhotographAtPitch seen;
    seen.part = {across.from, down.from, across.length, down.length};
    seen.middleOnly = shown.size() != photograph.photograph.size();
    if (size == shown.size())
        seen.rgb = shown.clone();
    else
        cv::resize(shown, seen.rgb, size, 0, 0, factor < 1 ? cv::INTER_AREA : cv::INTER_CUBIC);
    return seen;
}

cv::Rect usedPart(const InputPhotograph& photograph, const Architecture& architecture)
{
    double factor = 1;
    if (!architecture.sees && photograph.mmPerPixel) factor = *photograph.mmPerPixel / architecture.mmPerPixel;
    if (!architecture.sees && !photograph.mmPerPixel)
        factor = assumedMmPerPixel(photograph.photograph, architecture) / architecture.mmPerPixel;
    const UsedSide across = usedSide(photograph.photograph.cols, factor), down = usedSide(photograph.photograph.rows, factor);
    return {across.from, down.from, across.length, down.length};
}

}  // namespace rendering::models
