#include "rendering/fabrics/drawn/weave_strands.h"

#include <algorithm>
#include <cmath>

#include "rendering/fabrics/drawn/drawn_dye.h"

namespace rendering::fabrics {

namespace {

constexpr std::uint64_t warpYarnLattice = 0x71A1, weftYarnLattice = 0x71A2, crossingLattice = 0x71A3, glintLattice = 0x71A5;
constexpr int nodesPerCrossing = 4;

std::int64_t wrapped(std::int64_t place, int size) { return ((place % size) + size) % size; }

/// What is the same along a whole yarn.
struct YarnTraits {
    float offsetMm;   ///< displacement from its regular place
    float thickness;  ///< factor of the diameter
    float shade;
    float lift;  ///< a loose yarn stands out, as a share of its half height
    bool isMissing;
};

YarnTraits traitsOf(const DrawnFabric& fabric, bool isWarp, std::int64_t yarn)
{
    const DrawnYarns& yarns = isWarp ? fabric.warp : fabric.weft;
    const std::uint64_t bits = hashAt(fabric.seed ^ (isWarp ? warpYarnLattice : weftYarnLattice), yarn, -7);
    const std::uint64_t more = hashAt(bits, yarn, 3);
    const float first = inUnitRange(std::uint32_t(bits)), second = inUnitRange(std::uint32_t(bits >> 32));
    const float third = inUnitRange(std::uint32_t(more)), fourth = 0.5f + 0.5f * inUnitRange(std::uint32_t(more >> 32));
    YarnTraits traits{};
    // Uniform numbers on [-1, 1] have the standard deviation 0.577.
    traits.offsetMm = float(1.2 * yarns.displacement * yarns.spacingMm) * first;
    traits.thickness = std::max(0.4f, 1 + float(1.2 * yarns.unevenness) * second);
    traits.shade = 1 + float(1.7 * fabric.dye.unlevel) * third;
    traits.isMissing = fourth < float(yarns.missingShare);
    traits.lift = fourth > 1 - float(yarns.looseShare) ? 0.5f : 0.f;
    return traits;
}

/// One system of yarns of a weave, and what crosses it.
class WeaveSystem {
public:
    WeaveSystem(const DrawnFabric& fabric, bool isWarp)
        : m_fabric(fabric),
          m_isWarp(isWarp),
          m_places(floatPlaces(fabric.weave.draft, isWarp)),
          m_crossingPlaces(floatPlaces(fabric.weave.draft, !isWarp))
    {
        const double sum = (fabric.warp.diameterMm * fabric.warp.flatness + fabric.weft.diameterMm * fabric.weft.flatness) / 2;
        m_glint = float(0.08 + 0.35 * fabric.sheen);
        m_crimp = float(fabric.looseness * sum * (isWarp ? fabric.crimpShare : 1 - fabric.crimpShare));
    }

    const DrawnYarns& yarns() const { return m_isWarp ? m_fabric.warp : m_fabric.weft; }
    const DrawnYarns& crossing() const { return m_isWarp ? m_fabric.weft : m_fabric.warp; }

    /// Height of the axis at crossing `k` of `yarn` in mm, and how much of the float is seen there.
    struct Level {
        float z, widening, shade, turn;
    };
    Level levelAt(std::int64_t yarn, std::int64_t k) const
    {
        const Draft& draft = m_fabric.weave.draft;
        const std::int64_t warp = m_isWarp ? yarn : k, weft = m_isWarp ? k : yarn;
        const bool up = draft.warpIsUp(warp, weft) == m_isWarp;
        const FloatPlace& place = m_places[std::size_t(wrapped(weft, draft.wefts) * draft.warps + wrapped(warp, draft.warps))];
        const float freed = std::min(1.f, (place.length - 1) / 3);
        const float jitter = inUnitRange(std::uint32_t(hashAt(m_fabric.seed ^ crossingLattice, warp, weft)));
        const float bow = 1 + 0.45f * freed * place.middle + (0.10f + 0.12f * freed) * jitter;
        const float sunk = up && place.length < 1.5f ? 0.5f * neighbourFreedom(yarn, k) : 0;
        const std::uint64_t own = hashAt(m_fabric.seed ^ glintLattice, yarn, 2 * k + (m_isWarp ? 1 : 0));
        return {(up ? m_crimp : -m_crimp) * bow * (1 - sunk), up ? freed * (0.4f + 0.6f * place.middle) - 0.4f * sunk : -0.2f,
                1 + 0.07f * inUnitRange(std::uint32_t(own)), m_glint * inUnitRange(std::uint32_t(own >> 32))};
    }

    /// Freedom, 0 to 1, of the floats of the other system beside this crossing. Long floats close over a yarn that comes up once.
    float neighbourFreedom(std::int64_t yarn, std::int64_t k) const
    {
        const Draft& draft = m_fabric.weave.draft;
        float sum = 0;
        for (const int side : {-1, 1}) {
            const std::int64_t warp = m_isWarp ? yarn : k + side, weft = m_isWarp ? k + side : yarn;
            const FloatPlace& place =
                m_crossingPlaces[std::size_t(wrapped(weft, draft.wefts) * draft.warps + wrapped(warp, draft.warps))];
            sum += 0.5f * std::min(1.f, (place.length - 1) / 4);
        }
        return sum;
    }

private:
    const DrawnFabric& m_fabric;
    bool m_isWarp;
    std::vector<FloatPlace> m_places, m_crossingPlaces;
    float m_crimp;
    float m_glint;  ///< how far the fibres of a float lie aside, radians
};

StrandStyle styleOf(const DrawnFabric& fabric, const DrawnYarns& yarns, std::uint64_t seed)
{
    StrandStyle style;
    style.twist = float(yarns.twistDegrees * std::numbers::pi / 180);
    style.plies = yarns.plies;
    style.plyDepth = yarns.plies > 1 ? 0.22f : 0;
    style.fibreDepth = float(0.05 + 0.10 * fabric.hairiness);
    style.fibreShade = float(0.04 + 0.16 * fabric.hairiness);
    style.seed = seed;
    return style;
}

/// Nodes of one yarn between two crossings.
void followYarn(std::vector<StrandNode>& nodes, const DrawnFabric& fabric, const ClothFrame& frame, const WeaveSystem& system,
                bool isWarp, std::int64_t yarn, std::int64_t first, std::int64_t last, const YarnTraits& traits)
{
    const DrawnYarns& yarns = system.yarns();
    const double across = (double(yarn) + 0.5) * yarns.spacingMm + double(traits.offsetMm);
    const std::uint64_t lattice = fabric.seed ^ (isWarp ? warpYarnLattice : weftYarnLattice);
    const float halfWidthMm = 0.5f * float(yarns.diameterMm) * traits.thickness;
    const float lift = traits.lift * halfWidthMm * float(yarns.flatness);
    const float turnMm = 2.2f * halfWidthMm / std::max(0.08f, std::tan(std::abs(float(yarns.twistDegrees)) * 0.01745f));
    const auto crossingAt = [&](std::int64_t k) {
        return (double(k) + 0.5) * system.crossing().spacingMm + double(traitsOf(fabric, !isWarp, k).offsetMm);
    };
    double here = crossingAt(first);
    WeaveSystem::Level level = system.levelAt(yarn, first);
    nodes.clear();
    for (std::int64_t k = first; k < last; ++k) {
        const double next = crossingAt(k + 1);
        const WeaveSystem::Level nextLevel = system.levelAt(yarn, k + 1);
        for (int part = 0; part < nodesPerCrossing; ++part) {
            const float t = float(part) / nodesPerCrossing, blend = smoothStep(std::clamp(1.5f * t - 0.25f, 0.f, 1.f));
            const double along = here + (next - here) * double(t);
            const float cells = float(along / (7 * yarns.spacingMm));
            const NoisePair slow = noiseAlong(lattice, yarn, cells + 0.37f * float(yarn & 7));
            const NoisePair quick = noiseAlong(lattice ^ 0x55, yarn, 4.3f * cells);
            const float wobble = float(yarns.displacement * yarns.spacingMm) * (1.1f * slow.first + 0.5f * quick.first);
            const double side = across + double(wobble);
            const double u = isWarp ? side : along, v = isWarp ? along : side;
            const cv::Point2f pixel = frame.toPixel(u, v);
            const float widening = level.widening + (nextLevel.widening - level.widening) * blend;
            const float thick = std::max(0.35f, 1 + float(yarns.unevenness) * (1.3f * slow.second + 0.7f * quick.second));
            StrandNode node;
            node.x = pixel.x;
            node.y = pixel.y;
            node.z = level.z + (nextLevel.z - level.z) * blend + lift;
            node.halfWidth = halfWidthMm * thick * (1 + float(yarns.spread) * widening) / float(frame.pitchMm());
            node.halfHeight = halfWidthMm * thick * float(yarns.flatness);
            node.phase = float(along / double(turnMm)) + 0.15f * slow.first;
            node.shade = traits.shade * (1 + 0.04f * slow.second) * (level.shade + (nextLevel.shade - level.shade) * t);
            node.turn = level.turn + (nextLevel.turn - level.turn) * t;
            const Reflectance colour = dyedColour(fabric, isWarp, yarn, u, v, node.z < 0);
            std::copy(colour.begin(), colour.end(), node.colour);
            nodes.push_back(node);
        }
        here = next;
        level = nextLevel;
    }
}

}  // namespace

void layWeave(StrandCanvas& canvas, const DrawnFabric& fabric, const ClothFrame& frame)
{
    std::vector<StrandNode> nodes;
    for (const bool isWarp : {true, false}) {
        const WeaveSystem system(fabric, isWarp);
        const double spacing = system.yarns().spacingMm, other = system.crossing().spacingMm;
        const ClothExtent extent = frame.extent(2 * std::max(spacing, other));
        const double low = isWarp ? extent.left : extent.top, high = isWarp ? extent.right : extent.bottom;
        const auto first = std::int64_t(std::floor((isWarp ? extent.top : extent.left) / other));
        const auto last = std::int64_t(std::ceil((isWarp ? extent.bottom : extent.right) / other));
        for (auto yarn = std::int64_t(std::floor(low / spacing)); yarn <= std::int64_t(std::ceil(high / spacing)); ++yarn) {
            const YarnTraits traits = traitsOf(fabric, isWarp, yarn);
            if (traits.isMissing) continue;
            followYarn(nodes, fabric, frame, system, isWarp, yarn, first, last, traits);
            canvas.draw(nodes, styleOf(fabric, system.yarns(), hashAt(fabric.seed, yarn, isWarp ? 1 : 2)));
        }
    }
}

}  // namespace rendering::fabrics
