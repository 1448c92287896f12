#include "rendering/fabrics/drawn/knit_strands.h"

#include <algorithm>
#include <cmath>

#include "rendering/fabrics/drawn/drawn_dye.h"

namespace rendering::fabrics {

namespace {

constexpr std::uint64_t stitchLattice = 0x82B1, courseLattice = 0x82B2;
constexpr int nodesPerStitch = 16;
constexpr double loopLength = 2.9;  // Yarn of a stitch, in spacings of the wales.

/// +1 where the stitch shows its legs, -1 where it shows its head and feet; and its level, mm.
struct StitchSide {
    float side, levelMm;
};

StitchSide sideOf(const DrawnFabric& fabric, std::int64_t wale, std::int64_t course)
{
    const auto inBand = [](std::int64_t place, std::int64_t width) {
        return ((place % (2 * width)) + 2 * width) % (2 * width) < width;
    };
    switch (fabric.kind) {
        case ClothKind::Rib: {
            const auto width = std::max<std::int64_t>(1, std::llround(fabric.pile.ribPeriodMm / fabric.warp.spacingMm));
            const float side = inBand(wale, width) ? 1.f : -1.f;
            return {side, 0.5f * side * float(fabric.pile.ribShare * fabric.warp.diameterMm)};
        }
        case ClothKind::Purl: {
            const auto height = std::max<std::int64_t>(1, std::llround(fabric.pile.ribPeriodMm / fabric.warp.spacingMm));
            const float side = inBand(course, height) ? -1.f : 1.f;
            return {side, -0.4f * side * float(fabric.pile.ribShare * fabric.warp.diameterMm)};
        }
        default:
            return {1.f, 0.f};
    }
}

/// One point of a loop, in mm from the left foot of the stitch.
struct LoopPoint {
    double x, y, z;
};

LoopPoint loopAt(const DrawnFabric& fabric, double t, double side)
{
    const double wale = fabric.warp.spacingMm, course = fabric.weft.spacingMm;
    const double radius = fabric.warp.diameterMm / 2;
    const double depth = 0.75 * radius * fabric.looseness;
    return {t / (2 * std::numbers::pi) * wale + 0.21 * wale * std::sin(2 * t), -0.95 * course * std::cos(t),
            -side * depth * std::cos(2 * t)};
}

void followCourse(std::vector<StrandNode>& nodes, const DrawnFabric& fabric, const ClothFrame& frame, std::int64_t course,
                  std::int64_t first, std::int64_t last)
{
    const double wale = fabric.warp.spacingMm, spacing = fabric.weft.spacingMm;
    const DrawnYarns& yarns = fabric.warp;
    const float shade =
        1 + float(1.7 * fabric.dye.unlevel) * inUnitRange(std::uint32_t(hashAt(fabric.seed ^ courseLattice, course, 1)));
    const float reach = float(yarns.displacement * wale);
    const bool halfStep = fabric.kind == ClothKind::Interlock;
    const double turnMm = 2.2 * yarns.diameterMm / 2 / std::max(0.08, std::tan(std::abs(yarns.twistDegrees) * 0.01745));
    nodes.clear();
    for (std::int64_t k = first; k < last; ++k) {
        const StitchSide stitch = sideOf(fabric, k, course), next = sideOf(fabric, k + 1, course);
        const NoisePair own = noiseAt(fabric.seed ^ stitchLattice, float(k), float(course)),
                        after = noiseAt(fabric.seed ^ stitchLattice, float(k) + 1, float(course));
        const double shift = halfStep && (k & 1) != 0 ? 0.5 * spacing : 0;
        for (int part = 0; part < nodesPerStitch; ++part) {
            const double share = double(part) / nodesPerStitch, t = 2 * std::numbers::pi * share;
            const LoopPoint point = loopAt(fabric, t, double(stitch.side));
            const float blend = smoothStep(std::clamp(float(share) * 3 - 2, 0.f, 1.f));
            const float wobbleX = own.first + (after.first - own.first) * float(share),
                        wobbleY = own.second + (after.second - own.second) * float(share);
            const double u = double(k) * wale + point.x + double(1.6f * reach * wobbleX);
            const double v =
                double(course) * spacing + point.y + double(1.6f * reach * wobbleY) + shift * (0.5 - 0.5 * std::cos(2 * t)) * 0.5;
            const cv::Point2f pixel = frame.toPixel(u, v);
            const NoisePair thick = noiseAlong(fabric.seed ^ courseLattice, course, float(k) * 0.7f + 0.7f * float(share));
            StrandNode node;
            node.x = pixel.x;
            node.y = pixel.y;
            node.z = float(point.z) + stitch.levelMm + (next.levelMm - stitch.levelMm) * blend +
                     0.06f * float(yarns.diameterMm) * wobbleX;
            node.halfHeight =
                0.5f * float(yarns.diameterMm * yarns.flatness) * (1 + float(1.5 * yarns.unevenness) * thick.second);
            node.halfWidth = node.halfHeight / float(yarns.flatness * frame.pitchMm());
            node.phase = float((double(k) + share) * loopLength * wale / turnMm);
            node.shade = shade * (1 + 0.05f * thick.first);
            const Reflectance colour = dyedColour(fabric, fabric.dye.kind != DyeKind::TwoSystems, course, u, v, node.z < 0);
            std::copy(colour.begin(), colour.end(), node.colour);
            nodes.push_back(node);
        }
    }
}

}  // namespace

void layKnit(StrandCanvas& canvas, const DrawnFabric& fabric, const ClothFrame& frame)
{
    const double wale = fabric.warp.spacingMm, course = fabric.weft.spacingMm;
    const ClothExtent extent = frame.extent(2 * std::max(wale, course));
    const auto first = std::int64_t(std::floor(extent.left / wale)), last = std::int64_t(std::ceil(extent.right / wale));
    StrandStyle style;
    style.isBent = true;
    style.twist = float(fabric.warp.twistDegrees * std::numbers::pi / 180);
    style.plies = fabric.warp.plies;
    style.plyDepth = style.plies > 1 ? 0.22f : 0;
    style.fibreDepth = float(0.05 + 0.12 * fabric.hairiness);
    style.fibreShade = float(0.05 + 0.17 * fabric.hairiness);
    std::vector<StrandNode> nodes;
    for (auto row = std::int64_t(std::floor(extent.top / course)); row <= std::int64_t(std::ceil(extent.bottom / course));
         ++row) {
        followCourse(nodes, fabric, frame, row, first, last);
        style.seed = hashAt(fabric.seed, row, 5);
        canvas.draw(nodes, style);
    }
}

}  // namespace rendering::fabrics
