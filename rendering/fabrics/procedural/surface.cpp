#include "rendering/fabrics/procedural/surface.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "rendering/fabrics/procedural/lattice_noise.h"
#include "rendering/fabrics/procedural/loop_tile.h"

namespace rendering::fabrics {

namespace {

// Each kind of irregularity has its own lattice, so that the kinds are independent.
constexpr std::uint64_t warpLattice = 0x57A1, weftLattice = 0x57A2, wanderLattice = 0x57A3, hairLattice = 0x57A4,
                        pebbleLattice = 0x57A5, tuftLattice = 0x57A6, wavinessLattice = 0x57A7;

constexpr float yarnCellMm = 2.2f;      // A yarn's thickness and position change over this length.
constexpr float wanderCellMm = 7.0f;    // Size of the slow distortions of the fabric.
constexpr float wavinessCellMm = 9.0f;  // Size of its slow undulation.
constexpr float hairCellMm = 0.11f;
constexpr float wavinessMm = 0.02f;
constexpr float gapShade = 0.45f;

float bilinearPeriodic(const cv::Mat& tile, float x, float y)
{
    const float column = std::floor(x), row = std::floor(y);
    const float bx = x - column, by = y - row;
    const int c0 = int(column) % tile.cols, r0 = int(row) % tile.rows;
    const int c1 = (c0 + 1) % tile.cols, r1 = (r0 + 1) % tile.rows;
    const float* upper = tile.ptr<float>(r0);
    const float* lower = tile.ptr<float>(r1);
    return (upper[c0] * (1 - bx) + upper[c1] * bx) * (1 - by) + (lower[c0] * (1 - bx) + lower[c1] * bx) * by;
}

float fraction(float value) { return value - std::floor(value); }

}  // namespace

FabricSurface::FabricSurface(const Structure& structure, std::uint64_t seed) : m_structure(&structure), m_seed(seed)
{
    const double sum =
        (structure.warp.diameter * structure.warp.flatness + structure.weft.diameter * structure.weft.flatness) / 2;
    m_warpCrimp = float(structure.crimpShare * sum);
    m_weftCrimp = float((1 - structure.crimpShare) * sum);
    if (structure.construction == Construction::Jersey || structure.construction == Construction::Rib) {
        const LoopTile tile = drawLoops(structure);
        m_loops = tile.heightMm;
        m_loopsWidthMm = tile.widthMm;
        m_loopsHeightMm = tile.lengthMm;
    }
}

SurfacePatch FabricSurface::sample(const FabricPlace& place, cv::Size size, double pitchMm) const
{
    SurfacePatch patch{cv::Mat(size, CV_32FC1), cv::Mat(size, CV_32FC1)};
    const double angle = place.rotationDeg * std::numbers::pi / 180;
    const double cosine = std::cos(angle), sine = std::sin(angle);
    for (int row = 0; row < size.height; ++row) {
        float* heights = patch.heightMm.ptr<float>(row);
        float* shades = patch.shade.ptr<float>(row);
        const double y = (row - (size.height - 1) / 2.0) * pitchMm;
        for (int column = 0; column < size.width; ++column) {
            const double x = (column - (size.width - 1) / 2.0) * pitchMm;
            const SurfacePoint point = at(float(place.xMm + cosine * x - sine * y), float(place.yMm + sine * x + cosine * y));
            heights[column] = point.height;
            shades[column] = point.shade;
        }
    }
    return patch;
}

FabricSurface::SurfacePoint FabricSurface::at(float u, float v) const
{
    const NoisePair wander = noiseAt(m_seed ^ wanderLattice, u / wanderCellMm, v / wanderCellMm);
    const float reach = 2.5f * float(m_structure->displacementMm);
    const float wanderedU = u + reach * wander.first, wanderedV = v + reach * wander.second;
    const bool knitted = !m_loops.empty();
    SurfacePoint point = knitted ? knittedAt(wanderedU, wanderedV) : wovenAt(wanderedU, wanderedV);
    if (m_structure->construction == Construction::Corduroy) point = withPile(point, wanderedU, wanderedV);
    const NoisePair hair = noiseAt(m_seed ^ hairLattice, u / hairCellMm, v / hairCellMm);
    const float hairiness = float(m_structure->hairiness);
    point.height += 0.022f * hairiness * hair.first + cellsAt(wanderedU, wanderedV) +
                    wavinessMm * noiseAt(m_seed ^ wavinessLattice, u / wavinessCellMm, v / wavinessCellMm).first;
    point.shade *= 1 + 0.06f * hairiness * hair.second;
    return point;
}

FabricSurface::SurfacePoint FabricSurface::wovenAt(float u, float v) const
{
    const Structure& s = *m_structure;
    const float floor = -1.3f * std::max(float(s.warp.diameter * s.warp.flatness), float(s.weft.diameter * s.weft.flatness));
    SurfacePoint best{floor, gapShade};
    const auto consider = [&](bool isWarp, float across, float along, float spacing) {
        const float place = across / spacing;
        const auto yarn = std::int64_t(std::floor(place));
        const std::int64_t neighbour = fraction(place) < 0.5f ? yarn - 1 : yarn + 1;
        for (const std::int64_t candidate : {yarn, neighbour}) {
            const SurfacePoint point = yarnAt(isWarp, candidate, across, along);
            if (point.height > best.height) best = point;
        }
    };
    consider(true, u, v, float(s.warp.spacing));
    consider(false, v, u, float(s.weft.spacing));
    return best;
}

FabricSurface::SurfacePoint FabricSurface::yarnAt(bool isWarp, std::int64_t yarn, float across, float along) const
{
    const Yarns& yarns = isWarp ? m_structure->warp : m_structure->weft;
    const NoisePair noise =
        noiseAlong(m_seed ^ (isWarp ? warpLattice : weftLattice), yarn, along / yarnCellMm + 0.37f * float(yarn & 7));
    float centre = (float(yarn) + 0.5f) * float(yarns.spacing) + float(m_structure->displacementMm) * noise.first;
    if (isWarp) centre += float(m_structure->leno * yarns.spacing) * ((yarn & 1) != 0 ? -1.f : 1.f);
    const float halfWidth = 0.5f * float(yarns.diameter) * (1 + 2 * float(yarns.unevenness) * noise.second);
    const float side = (across - centre) / halfWidth;
    if (std::abs(side) >= 1) return {-1e3f, 0};
    const float roundness = std::sqrt(1 - side * side);
    const float halfHeight = halfWidth * float(yarns.flatness);
    // Fibres wind around the yarn. From above they are oblique lines that lie closer together towards its edges.
    const float turn = 2.2f * halfWidth / std::max(0.15f, std::tan(float(yarns.twistDegrees) * float(std::numbers::pi) / 180));
    const float winding = 3 * along / turn + 0.5f * std::asin(side) + 0.25f * noise.first;
    const float fibre = std::abs(2 * fraction(winding) - 1);  // Triangle wave; 0 in the groove between fibres.
    const float height = axisHeight(isWarp, yarn, along) + halfHeight * roundness + 0.05f * halfHeight * (fibre - 0.5f);
    const float shade = (0.72f + 0.28f * roundness) * (0.94f + 0.09f * fibre) * (1 + 0.05f * noise.second);
    return {height, shade};
}

float FabricSurface::axisHeight(bool isWarp, std::int64_t yarn, float along) const
{
    const float spacing = float(isWarp ? m_structure->weft.spacing : m_structure->warp.spacing);
    const float place = along / spacing - 0.5f;
    const auto crossing = std::int64_t(std::floor(place));
    const auto up = [&](std::int64_t k) {
        return isWarp ? m_structure->draft.warpIsUp(yarn, k) : !m_structure->draft.warpIsUp(k, yarn);
    };
    const float here = up(crossing) ? 1.f : -1.f, next = up(crossing + 1) ? 1.f : -1.f;
    const float t = fraction(place);
    const float crimp = isWarp ? m_warpCrimp : m_weftCrimp;
    const float bow = here == next ? 0.25f * here * 4 * t * (1 - t) : 0;
    return crimp * (here + (next - here) * smoothStep(t) + bow);
}

FabricSurface::SurfacePoint FabricSurface::knittedAt(float u, float v) const
{
    const float wale = float(m_structure->warp.spacing), course = float(m_structure->weft.spacing);
    const NoisePair stitch = noiseAt(m_seed ^ warpLattice, u / (1.3f * wale), v / (1.3f * course));
    const float reach = float(m_structure->displacementMm);
    const float x = (u + reach * stitch.first) / float(m_loopsWidthMm);
    const float y = (v + reach * stitch.second) / float(m_loopsHeightMm);
    const float height = bilinearPeriodic(m_loops, fraction(x) * float(m_loops.cols), fraction(y) * float(m_loops.rows));
    const float radius = 0.5f * float(m_structure->warp.diameter);
    const float openness = std::clamp((height + 1.6f * radius) / (1.8f * radius), 0.f, 1.f);
    const NoisePair fibre = noiseAt(m_seed ^ weftLattice, (u + 0.7f * v) / 0.09f, (v - 0.4f * u) / 0.35f);
    return {height + 0.008f * fibre.first, (gapShade + (1 - gapShade) * openness) * (1 + 0.07f * fibre.second)};
}

FabricSurface::SurfacePoint FabricSurface::withPile(SurfacePoint ground, float u, float v) const
{
    const float period = float(m_structure->cells.period);
    const NoisePair tuft = noiseAt(m_seed ^ tuftLattice, u / 0.16f, v / 0.30f);
    const NoisePair drift = noiseAt(m_seed ^ weftLattice, u / period, v / 1.2f);
    const float side = (2 * fraction(u / period) - 1) / (0.84f + 0.05f * drift.first);
    if (std::abs(side) >= 1) return {ground.height, ground.shade * 0.8f};
    const float dome = std::sqrt(1 - side * side);
    const float row = 0.5f + 0.5f * std::cos(2 * float(std::numbers::pi) * (v / 0.42f + 0.3f * drift.second));
    const float height = float(m_structure->pileMm) * (dome - 0.08f) + 0.035f * row * dome + 0.055f * tuft.first * dome;
    if (height <= ground.height) return ground;
    return {height, (0.70f + 0.30f * dome) * (1 + 0.10f * tuft.second) * (0.96f + 0.06f * row)};
}

float FabricSurface::cellsAt(float u, float v) const
{
    const CellRelief& cells = m_structure->cells;
    if (cells.depth == 0 || m_structure->construction == Construction::Rib) return 0;
    const float period = float(cells.period), depth = float(cells.depth);
    if (!cells.regular) {
        const NoisePair coarse = noiseAt(m_seed ^ pebbleLattice, u / period, v / period);
        const NoisePair fine = noiseAt(m_seed ^ tuftLattice, 2.3f * u / period, 2.3f * v / period);
        return depth * (0.6f * coarse.first + 0.4f * fine.first);
    }
    const float x = std::abs(2 * fraction(u / period) - 1), y = std::abs(2 * fraction(v / period) - 1);
    const float border = std::max(x, y);
    return depth * (border * border - 0.5f);
}

}  // namespace rendering::fabrics
