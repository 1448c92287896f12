#include "rendering/fabrics/drawn/pile_strands.h"

#include <algorithm>
#include <cmath>

#include "rendering/fabrics/drawn/drawn_dye.h"

namespace rendering::fabrics {

namespace {

constexpr std::uint64_t tuftDrawLattice = 0x93C1, napLattice = 0x93C2, tuftShapeLattice = 0x93C3, cordLattice = 0x93C4;
constexpr float halfTurn = float(std::numbers::pi);

/// Three uniform numbers in [-1, 1] of a tuft.
struct TuftDraw {
    float a, b, c, d;
};
TuftDraw tuftDraw(std::uint64_t seed, std::int64_t i, std::int64_t j)
{
    const std::uint64_t bits = hashAt(seed, i, j), more = hashAt(bits, j, i);
    return {inUnitRange(std::uint32_t(bits)), inUnitRange(std::uint32_t(bits >> 32)), inUnitRange(std::uint32_t(more)),
            inUnitRange(std::uint32_t(more >> 32))};
}

/// Range of lattice points that may be seen.
struct CellRange {
    std::int64_t left, right, top, bottom;
};
CellRange cellsIn(const ClothExtent& extent, double stepX, double stepY)
{
    return {std::int64_t(std::floor(extent.left / stepX)), std::int64_t(std::ceil(extent.right / stepX)),
            std::int64_t(std::floor(extent.top / stepY)), std::int64_t(std::ceil(extent.bottom / stepY))};
}

void placeNode(StrandNode& node, const ClothFrame& frame, double u, double v)
{
    const cv::Point2f pixel = frame.toPixel(u, v);
    node.x = pixel.x;
    node.y = pixel.y;
}

void paintNode(StrandNode& node, const DrawnFabric& fabric, double u, double v, float shade)
{
    const auto yarn = std::int64_t(std::floor(u / fabric.warp.spacingMm));
    const Reflectance colour = dyedColour(fabric, true, yarn, u, v, false);
    std::copy(colour.begin(), colour.end(), node.colour);
    node.shade = shade;
}

/// Direction of the nap at a place, radians: the lay of the fabric, bent by slow noise, and a share of chance.
float napAt(const DrawnFabric& fabric, double u, double v, float chance)
{
    const float scale = 1 / float(6 * fabric.pile.lengthMm + 2 * fabric.pile.spacingMm);
    const NoisePair bend = noiseAt(fabric.seed ^ napLattice, float(u) * scale, float(v) * scale);
    const float freedom = 1 - float(fabric.pile.order);
    return float(fabric.pile.napDegrees) * halfTurn / 180 + 1.2f * bend.first * (0.3f + freedom) +
           halfTurn * freedom * freedom * chance + 0.35f * freedom * chance;
}

}  // namespace

void layTufts(StrandCanvas& canvas, const DrawnFabric& fabric, const ClothFrame& frame)
{
    const DrawnPile& pile = fabric.pile;
    const bool nap = fabric.kind == ClothKind::Weave, cut = fabric.kind == ClothKind::CutPile;
    const double step = cut ? 0.65 * pile.spacingMm : pile.spacingMm;  // The tips of a cut pile close over their roots.
    const ClothExtent extent = frame.extent(pile.lengthMm + 2 * step);
    const CellRange cells = cellsIn(extent, step, step);
    const float lump = nap ? 0.f : 1.f;
    const float lumpScale = 1 / float(cut ? 8 * step : 2.5 * pile.lengthMm);
    const int bends = pile.lengthMm > 4 * pile.widthMm ? 6 : 3;
    StrandStyle style;
    style.isDome = true;
    style.twist = 0;
    style.fibreDepth = nap ? 0.1f : 0.25f;
    style.fibreShade = nap ? 0.1f : float(0.08 + 0.12 * fabric.hairiness);
    std::vector<StrandNode> nodes;
    for (std::int64_t j = cells.top; j <= cells.bottom; ++j)
        for (std::int64_t i = cells.left; i <= cells.right; ++i) {
            const TuftDraw draw = tuftDraw(fabric.seed ^ tuftDrawLattice, i, j),
                           more = tuftDraw(fabric.seed ^ tuftShapeLattice, i, j);
            double u = (double(i) + 0.5 + 0.5 * double(draw.a)) * step, v = (double(j) + 0.5 + 0.5 * double(draw.b)) * step;
            float direction = napAt(fabric, u, v, draw.c);
            const NoisePair dome = noiseAt(fabric.seed ^ tuftShapeLattice, float(u) * lumpScale, float(v) * lumpScale);
            const float base = float(pile.heightMm) * (lump * 0.6f * dome.first + 0.45f * draw.d);
            const float length = float(pile.lengthMm) * (1 + 0.35f * more.a) / float(bends);
            const float width = float(pile.widthMm) * (1 + 0.3f * more.b);
            const float curl = (nap || bends > 3 ? 0.35f : 0.5f) * more.c;
            const float shade = 1 + 0.10f * more.d;
            style.seed = hashAt(fabric.seed, i, j);
            nodes.clear();
            for (int k = 0; k <= bends; ++k) {
                const float share = float(k) / float(bends), bell = std::sin(halfTurn * (0.12f + 0.76f * share));
                StrandNode node;
                placeNode(node, frame, u, v);
                // A lock rises to its tip, which lies over the roots of the next.
                node.z = base + float(pile.heightMm) * (cut ? 0.5f : 0.5f) * (share - 0.5f) +
                         (nap ? float(0.25 * fabric.warp.diameterMm) : 0);
                node.halfWidth = std::max(0.55f, 0.5f * width * bell / float(frame.pitchMm()));
                node.halfHeight = 0.35f * width * bell;
                node.phase = 0.35f * share * float(bends) + draw.a;
                paintNode(node, fabric, u, v, shade * (0.90f + 0.14f * share));
                nodes.push_back(node);
                u += double(length * std::cos(direction));
                v += double(length * std::sin(direction));
                direction += curl;
            }
            canvas.draw(nodes, style);
        }
}

void layTerry(StrandCanvas& canvas, const DrawnFabric& fabric, const ClothFrame& frame)
{
    const DrawnPile& pile = fabric.pile;
    const double step = pile.spacingMm;
    const CellRange cells = cellsIn(frame.extent(2 * pile.lengthMm + 2 * step), 0.8 * step, 0.55 * step);
    constexpr int parts = 9;
    StrandStyle style;
    style.isBent = true;
    style.twist = float(fabric.warp.twistDegrees * std::numbers::pi / 180);
    style.plies = 2;
    style.plyDepth = 0.2f;
    style.fibreDepth = 0.12f;
    style.fibreShade = float(0.06 + 0.14 * fabric.hairiness);
    std::vector<StrandNode> nodes;
    for (std::int64_t j = cells.top; j <= cells.bottom; ++j)
        for (std::int64_t i = cells.left; i <= cells.right; ++i) {
            const TuftDraw draw = tuftDraw(fabric.seed ^ tuftDrawLattice, i, j),
                           more = tuftDraw(fabric.seed ^ tuftShapeLattice, i, j);
            const double u = (double(i) + 0.5 * double(j & 1) + 0.25 * double(draw.a)) * 0.8 * step,
                         v = (double(j) + 0.25 * double(draw.b)) * 0.55 * step;
            const float direction = napAt(fabric, u, v, draw.c);
            const float across = direction + 0.5f * halfTurn + 0.8f * more.a;
            const float lean = float(pile.lengthMm) * (0.55f + 0.35f * draw.d),
                        foot = float(pile.widthMm) * (1.2f + 0.8f * more.b);
            const float upright = float(pile.heightMm) * (0.7f + 0.3f * more.c);
            style.seed = hashAt(fabric.seed, i, j);
            nodes.clear();
            for (int k = 0; k <= parts; ++k) {
                const float share = float(k) / parts, arch = std::sin(halfTurn * share), across01 = std::cos(halfTurn * share);
                const double nodeU = u + double(lean * arch * std::cos(direction) + foot * across01 * std::cos(across));
                const double nodeV = v + double(lean * arch * std::sin(direction) + foot * across01 * std::sin(across));
                StrandNode node;
                placeNode(node, frame, nodeU, nodeV);
                node.z = upright * std::sqrt(std::max(0.f, arch)) * (1 - 0.35f * arch) + 0.02f * more.d;
                node.halfHeight = 0.5f * float(pile.widthMm) * (0.9f + 0.15f * more.d);
                node.halfWidth = std::max(0.55f, node.halfHeight / float(frame.pitchMm()));
                node.phase = 1.4f * share * float(pile.lengthMm / pile.widthMm) + draw.a;
                paintNode(node, fabric, nodeU, nodeV, (0.86f + 0.16f * arch) * (1 + 0.05f * more.d));
                nodes.push_back(node);
            }
            canvas.draw(nodes, style);
        }
}

void layCorduroy(StrandCanvas& canvas, const DrawnFabric& fabric, const ClothFrame& frame)
{
    const DrawnPile& pile = fabric.pile;
    const double period = pile.ribPeriodMm, step = pile.spacingMm;
    const CellRange cells = cellsIn(frame.extent(2 * period + 2 * step), period, 0.5 * step);
    constexpr int parts = 12;
    StrandStyle style;
    style.isDome = true;
    style.twist = 1.2f;  // The fibres stand up, so they lie across the strand that outlines the rib.
    style.fibreDepth = 0.25f;
    style.fibreShade = float(0.08 + 0.14 * fabric.hairiness);
    std::vector<StrandNode> nodes;
    for (std::int64_t i = cells.left; i <= cells.right; ++i)
        for (std::int64_t j = cells.top; j <= cells.bottom; ++j) {
            const TuftDraw draw = tuftDraw(fabric.seed ^ tuftDrawLattice, i, j),
                           more = tuftDraw(fabric.seed ^ tuftShapeLattice, i, j);
            const NoisePair drift = noiseAlong(fabric.seed ^ cordLattice, i, float(double(j) * 0.5 * step / (2.5 * period)));
            const double v = (double(j) + 0.3 * double(draw.a)) * 0.5 * step;
            const double half = 0.5 * period * pile.ribShare * (1 + 0.08 * double(drift.first) + 0.10 * double(draw.b));
            const double middle =
                (double(i) + 0.5) * period + 0.06 * period * double(drift.second) + 0.03 * period * double(draw.c);
            const float top = float(pile.heightMm) * (1 + 0.10f * drift.first + 0.16f * draw.d);
            style.seed = hashAt(fabric.seed, i, j);
            nodes.clear();
            for (int k = 0; k <= parts; ++k) {
                const float side = 2 * float(k) / parts - 1;
                const float dome = std::pow(std::max(0.f, 1 - side * side), 0.6f);
                const double u = middle + half * double(side), bent = v + 0.25 * step * double(more.a) * double(side * side);
                StrandNode node;
                placeNode(node, frame, u, bent);
                node.z = top * dome + 0.08f * top * more.b * side;
                node.halfHeight = 0.18f * float(pile.widthMm) * (0.5f + 0.5f * dome);
                node.halfWidth = std::max(0.55f, 0.5f * float(pile.widthMm) * (1 + 0.25f * more.c) / float(frame.pitchMm()));
                node.phase = 2.2f * float(k) / parts * float(period / step) * 0.5f + draw.a;
                paintNode(node, fabric, u, bent, (0.70f + 0.32f * dome) * (1 + 0.08f * more.d));
                nodes.push_back(node);
            }
            canvas.draw(nodes, style);
        }
}

}  // namespace rendering::fabrics
