#include "rendering/fabrics/drawn/strand_canvas.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "rendering/fabrics/procedural/lattice_noise.h"

namespace rendering::fabrics {

namespace {

constexpr int sectionSteps = 64;
constexpr float groundShade = 0.35f;
constexpr float fibresOfPly = 5;
constexpr float overlap = 0.12f;  // Segments reach over their ends, so that bends have no gaps.

using Section = std::array<float, sectionSteps + 2>;

/// Height of a cross-section by the distance from its middle, both relative.
Section makeSection(bool isDome)
{
    Section section{};
    for (int i = 0; i <= sectionSteps; ++i) {
        const double side = double(i) / sectionSteps;
        section[std::size_t(i)] =
            float(isDome ? 1 - side * side : std::pow(1 - side * side, 0.5) * 0.85 + 0.15 * (1 - side * side));
    }
    return section;
}

const Section& sectionOf(bool isDome)
{
    static const Section yarn = makeSection(false), dome = makeSection(true);
    return isDome ? dome : yarn;
}

/// The whole number below; several times as fast as std::floor, which is a call here.
std::int64_t wholeBelow(float value)
{
    const auto whole = std::int64_t(value);
    return whole - (float(whole) > value ? 1 : 0);
}

float triangleWave(float turns) { return std::abs(2 * (turns - float(wholeBelow(turns))) - 1); }

/// Fades what is finer than the pixels.
float visibleShare(float pixelsPerTurn) { return std::clamp((pixelsPerTurn - 2) / 2, 0.f, 1.f); }

float mixOf(float a, float b, float share) { return a + share * (b - a); }

/// A straight piece of a strand, with what is the same for all its pixels.
class Segment {
public:
    Segment(const StrandNode& from, const StrandNode& to, const StrandStyle& style, float mmPerPixel)
        : m_from(from),
          m_to(to),
          m_style(style),
          m_section(sectionOf(style.isDome)),
          m_length(std::hypot(to.x - from.x, to.y - from.y)),
          m_reach(std::max(from.halfWidth, to.halfWidth)),
          m_beyond(style.isBent ? m_reach : std::max(overlap * m_length, std::min(0.3f * m_reach, 0.6f))),
          m_ux((to.x - from.x) / m_length),
          m_uy((to.y - from.y) / m_length)
    {
        const float slope = (to.z - from.z) / (m_length * mmPerPixel), norm = 1 / std::sqrt(1 + slope * slope);
        const float turn = std::cos(style.twist), lean = std::sin(style.twist);
        m_tangent[0] = (m_ux * turn - m_uy * lean) * norm;
        m_tangent[1] = (m_uy * turn + m_ux * lean) * norm;
        m_tangent[2] = slope * norm;
        const float turns = std::abs(to.phase - from.phase) + 1e-6f;
        m_plySeen = style.plyDepth * visibleShare(m_length / (turns * float(style.plies)));
        m_fibreTurns = fibresOfPly * float(style.plies);
        m_fibreSeen = visibleShare(std::min(m_length / (turns * m_fibreTurns), 0.5f * m_reach));
    }

    /// Pixels that the segment may cover. The box of a slanted segment is tight: only its ends are widened across.
    cv::Rect box(cv::Size size) const
    {
        const float acrossX = m_reach * std::abs(m_uy) + m_beyond * std::abs(m_ux);
        const float acrossY = m_reach * std::abs(m_ux) + m_beyond * std::abs(m_uy);
        const int left = std::max(0, int(std::ceil(std::min(m_from.x, m_to.x) - acrossX)));
        const int right = std::min(size.width - 1, int(std::floor(std::max(m_from.x, m_to.x) + acrossX)));
        const int top = std::max(0, int(std::ceil(std::min(m_from.y, m_to.y) - acrossY)));
        const int bottom = std::min(size.height - 1, int(std::floor(std::max(m_from.y, m_to.y) + acrossY)));
        return {left, top, std::max(0, right - left + 1), std::max(0, bottom - top + 1)};
    }

    /// A pixel in terms of the segment.
    struct Point {
        float along;      ///< 0 at the first node, 1 at the second
        float side;       ///< -1 to 1 across
        float roundness;  ///< height of the section, 0 at the edge to 1
    };
    std::optional<Point> at(float x, float y) const
    {
        const float px = x - m_from.x, py = y - m_from.y;
        const float free = (px * m_ux + py * m_uy) / m_length;
        const float past = std::max(0.f, std::abs(free - 0.5f) - 0.5f) * m_length;
        if (past > m_beyond) return std::nullopt;
        const float along = std::clamp(free, 0.f, 1.f);
        const float halfWidth = mixOf(m_from.halfWidth, m_to.halfWidth, along);
        const float side = (px * m_uy - py * m_ux) / halfWidth;
        // Ends are round, so that bends have no gaps.
        const float size = past == 0 ? std::abs(side) : std::sqrt(side * side + past * past / (halfWidth * halfWidth));
        if (size >= 1) return std::nullopt;
        const float place = size * sectionSteps;
        const auto step = std::size_t(place);
        return Point{along, side, mixOf(m_section[step], m_section[step + 1], place - float(step))};
    }

    /// Height without grooves, mm: an upper bound.
    float heightAt(const Point& point) const
    {
        return mixOf(m_from.z, m_to.z, point.along) + mixOf(m_from.halfHeight, m_to.halfHeight, point.along) * point.roundness;
    }

    struct Surface {
        float height;
        float tangent[3];
        float shade;
        float colour[3];
    };
    Surface surfaceAt(const Point& point) const
    {
        const float phase = mixOf(m_from.phase, m_to.phase, point.along), turns = phase * m_fibreTurns + 1.6f * point.side;
        const float groove = m_plySeen > 0 ? m_plySeen * triangleWave(phase * float(m_style.plies) + 0.32f * point.side) : 0;
        const float depth = groove + m_style.fibreDepth * m_fibreSeen * triangleWave(turns);
        const float speck =
            inUnitRange(std::uint32_t(hashAt(m_style.seed, wholeBelow(turns + 0.5f), std::int64_t(phase * 2.5f))));
        const float aside = 0.10f * speck + mixOf(m_from.turn, m_to.turn, point.along);
        Surface surface{};
        surface.height = heightAt(point) - mixOf(m_from.halfHeight, m_to.halfHeight, point.along) * depth;
        surface.tangent[0] = m_tangent[0] - aside * m_tangent[1];
        surface.tangent[1] = m_tangent[1] + aside * m_tangent[0];
        surface.tangent[2] = m_tangent[2];
        surface.shade = mixOf(m_from.shade, m_to.shade, point.along) * (1 - 0.5f * groove) * (0.88f + 0.12f * point.roundness) *
                        (1 + m_style.fibreShade * (0.4f + 0.6f * m_fibreSeen) * speck);
        for (int c = 0; c < 3; ++c) surface.colour[c] = mixOf(m_from.colour[c], m_to.colour[c], point.along);
        return surface;
    }

private:
    const StrandNode &m_from, &m_to;
    const StrandStyle& m_style;
    const Section& m_section;
    float m_length, m_reach, m_beyond, m_ux, m_uy;
    float m_tangent[3] = {0, 0, 0};
    float m_plySeen = 0, m_fibreTurns = 1, m_fibreSeen = 0;
};

}  // namespace

StrandCanvas::StrandCanvas(cv::Size size, double pitchMm, float groundMm)
    : heightMm(size, CV_32FC1, cv::Scalar(groundMm)),
      tangentX(size, CV_32FC1, cv::Scalar(0)),
      tangentY(size, CV_32FC1, cv::Scalar(0)),
      tangentZ(size, CV_32FC1, cv::Scalar(0)),
      shade(size, CV_32FC1, cv::Scalar(groundShade)),
      colour(size, CV_32FC3, cv::Scalar(0, 0, 0)),
      m_mmPerPixel(float(pitchMm))
{
}

void StrandCanvas::draw(std::span<const StrandNode> nodes, const StrandStyle& style)
{
    for (std::size_t i = 1; i < nodes.size(); ++i) drawSegment(nodes[i - 1], nodes[i], style);
}

void StrandCanvas::drawSegment(const StrandNode& from, const StrandNode& to, const StrandStyle& style)
{
    if (std::hypot(to.x - from.x, to.y - from.y) < 1e-3f) return;
    const Segment segment(from, to, style, m_mmPerPixel);
    const cv::Rect box = segment.box(heightMm.size());
    for (int y = box.y; y < box.y + box.height; ++y) {
        float* heights = heightMm.ptr<float>(y);
        for (int x = box.x; x < box.x + box.width; ++x) {
            const auto point = segment.at(float(x), float(y));
            if (!point || segment.heightAt(*point) <= heights[x]) continue;
            const auto seen = segment.surfaceAt(*point);
            if (seen.height <= heights[x]) continue;
            heights[x] = seen.height;
            tangentX.ptr<float>(y)[x] = seen.tangent[0];
            tangentY.ptr<float>(y)[x] = seen.tangent[1];
            tangentZ.ptr<float>(y)[x] = seen.tangent[2];
            shade.ptr<float>(y)[x] = seen.shade;
            std::copy(std::begin(seen.colour), std::end(seen.colour), colour.ptr<float>(y) + 3 * x);
        }
    }
}

}  // namespace rendering::fabrics
