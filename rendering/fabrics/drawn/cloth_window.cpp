#include "rendering/fabrics/drawn/cloth_window.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "rendering/fabrics/drawn/cloth_frame.h"
#include "rendering/fabrics/drawn/knit_strands.h"
#include "rendering/fabrics/drawn/pile_strands.h"
#include "rendering/fabrics/drawn/strand_canvas.h"
#include "rendering/fabrics/drawn/weave_strands.h"

namespace rendering::fabrics {

namespace {

constexpr std::uint64_t waveLattice = 0xA4D1, creaseLattice = 0xA4D2, speckleLattice = 0xA4D3;
constexpr int slackStep = 8;  // Slack is smooth, so every eighth pixel is enough.

/// What is seen between the yarns: the table, or the roots of a pile.
float groundOf(const DrawnFabric& fabric)
{
    if (fabric.kind == ClothKind::CutPile || fabric.kind == ClothKind::Fleece)
        return -float(0.8 * fabric.pile.heightMm + 0.2 * fabric.pile.widthMm);
    return -0.95f * float(std::max(fabric.warp.diameterMm * fabric.warp.flatness, fabric.weft.diameterMm * fabric.weft.flatness));
}

void layFabric(StrandCanvas& canvas, const DrawnFabric& fabric, const ClothFrame& frame)
{
    switch (fabric.kind) {
        case ClothKind::Weave:
            layWeave(canvas, fabric, frame);
            if (fabric.pile.heightMm > 0) layTufts(canvas, fabric, frame);
            return;
        case ClothKind::Jersey:
        case ClothKind::Rib:
        case ClothKind::Interlock:
        case ClothKind::Purl:
            layKnit(canvas, fabric, frame);
            return;
        case ClothKind::CutPile:
        case ClothKind::Fleece:
            layTufts(canvas, fabric, frame);
            return;
        case ClothKind::Terry:
            layWeave(canvas, fabric, frame);
            layTerry(canvas, fabric, frame);
            return;
        case ClothKind::Corduroy:
            layWeave(canvas, fabric, frame);
            layCorduroy(canvas, fabric, frame);
            return;
    }
}

float slackAt(const DrawnFabric& fabric, const cv::Point2d& place)
{
    const Slack& slack = fabric.slack;
    float height = 0;
    if (slack.waveMm > 0) {
        const float scale = 1 / float(slack.waveLengthMm);
        height += float(slack.waveMm) * noiseAt(fabric.seed ^ waveLattice, float(place.x) * scale, float(place.y) * scale).first;
    }
    if (slack.creaseMm > 0) {
        const float scale = 1 / float(slack.creaseLengthMm);
        const NoisePair fold = noiseAt(fabric.seed ^ creaseLattice, float(place.x) * scale, float(place.y) * scale);
        const float distance = fold.first / 0.2f;
        height += float(slack.creaseMm) * std::exp(-distance * distance) * (fold.second > 0 ? 1.f : -1.f) *
                  std::min(1.f, 6 * std::abs(fold.second));
    }
    return height;
}

/// A smooth field of the fabric, sampled at every `step` pixels: value(place) in mm.
template <class Value>
cv::Mat smoothField(const ClothFrame& frame, cv::Size size, int step, int interpolation, Value value)
{
    const cv::Size coarse(size.width / step + 4, size.height / step + 4);
    cv::Mat nodes(coarse, CV_32FC1), smooth;
    for (int y = 0; y < coarse.height; ++y)
        for (int x = 0; x < coarse.width; ++x)
            nodes.at<float>(y, x) = value(frame.toFabric((x - 1.5) * step - 0.5, (y - 1.5) * step - 0.5));
    cv::resize(nodes, smooth, {coarse.width * step, coarse.height * step}, 0, 0, interpolation);
    return smooth(cv::Rect(2 * step, 2 * step, size.width, size.height)).clone();
}

cv::Mat slackOf(const DrawnFabric& fabric, const ClothFrame& frame, cv::Size size)
{
    return smoothField(frame, size, slackStep, cv::INTER_CUBIC, [&](const cv::Point2d& place) { return slackAt(fabric, place); });
}

/// Relative shade of the dye, 1 on average.
cv::Mat speckleOf(const DrawnFabric& fabric, const ClothFrame& frame, cv::Size size)
{
    const float fine = 1 / float(0.4 * threadPeriod(fabric).mm), coarse = 1 / float(2.5 * threadPeriod(fabric).mm);
    const int step = std::max(1, int(0.15 * threadPeriod(fabric).mm / frame.pitchMm()));
    const auto depth = float(fabric.dye.speckle);
    return smoothField(frame, size, std::min(step, slackStep), cv::INTER_LINEAR, [&](const cv::Point2d& place) {
        const float small = noiseAt(fabric.seed ^ speckleLattice, float(place.x) * fine, float(place.y) * fine).first;
        const float large = noiseAt(fabric.seed ^ speckleLattice, float(place.x) * coarse, float(place.y) * coarse).second;
        return 1 + depth * (1.4f * small + 0.7f * large);
    });
}

}  // namespace

ClothWindow clothWindow(const DrawnFabric& fabric, const FabricPlace& place, cv::Size size, double pitchMm, SlackShown slack)
{
    const ClothFrame frame(fabric, place, size, pitchMm);
    const float ground = groundOf(fabric);
    StrandCanvas canvas(size, pitchMm, ground);
    layFabric(canvas, fabric, frame);
    ClothWindow window;
    window.heightMm = canvas.heightMm;
    window.tangentX = canvas.tangentX;
    window.tangentY = canvas.tangentY;
    window.tangentZ = canvas.tangentZ;
    window.cover = cv::Mat(size, CV_32FC1);
    const cv::Mat speckle = speckleOf(fabric, frame, size);
    for (int y = 0; y < size.height; ++y) {
        const float* speckles = speckle.ptr<float>(y);
        const float* heights = canvas.heightMm.ptr<float>(y);
        const float* shades = canvas.shade.ptr<float>(y);
        float* cover = window.cover.ptr<float>(y);
        float* rgb = canvas.colour.ptr<float>(y);
        for (int x = 0; x < size.width; ++x) {
            cover[x] = heights[x] > ground ? 1.f : 0.f;
            for (int c = 0; c < 3; ++c)
                rgb[3 * x + c] =
                    cover[x] > 0 ? rgb[3 * x + c] * shades[x] * speckles[x] : 0.3f * fabric.dye.colours[0][std::size_t(c)];
        }
    }
    window.colour = canvas.colour;
    cv::Scalar mean, deviation;
    cv::meanStdDev(window.heightMm, mean, deviation);
    window.textureSqMm = deviation[0];
    if (slack == SlackShown::Yes && (fabric.slack.waveMm > 0 || fabric.slack.creaseMm > 0))
        window.heightMm += slackOf(fabric, frame, size);
    return window;
}

}  // namespace rendering::fabrics
