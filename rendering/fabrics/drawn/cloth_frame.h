// From places of the fabric, mm, to pixels of a window, with the displacement of threads within the plane.
#pragma once

#include <cmath>
#include <numbers>
#include <opencv2/core/types.hpp>

#include "rendering/fabrics/drawn/drawn_fabric.h"
#include "rendering/fabrics/procedural/lattice_noise.h"
#include "rendering/fabrics/procedural/surface.h"

namespace rendering::fabrics {

/// Rectangle of the fabric, mm.
struct ClothExtent {
    double left, right, top, bottom;
};

class ClothFrame {
public:
    ClothFrame(const DrawnFabric& fabric, const FabricPlace& place, cv::Size size, double pitchMm)
        : m_place(place),
          m_pitchMm(pitchMm),
          m_centreX((size.width - 1) / 2.0),
          m_centreY((size.height - 1) / 2.0),
          m_cosine(std::cos(place.rotationDeg * std::numbers::pi / 180)),
          m_sine(std::sin(place.rotationDeg * std::numbers::pi / 180)),
          m_skew(std::tan(fabric.slack.skewDegrees * std::numbers::pi / 180)),
          m_wander(float(fabric.slack.wanderMm)),
          m_wanderLength(1 / float(fabric.slack.wanderLengthMm)),
          m_seed(fabric.seed ^ 0x3A1D)
    {
    }

    double pitchMm() const { return m_pitchMm; }

    /// Pixel of the thread that lies at (u, v) in a perfect fabric. Skew slants the weft, noise displaces both systems.
    cv::Point2f toPixel(double u, double v) const
    {
        const NoisePair noise = noiseAt(m_seed, float(u) * m_wanderLength, float(v) * m_wanderLength);
        const double x = u + double(m_wander * noise.first) - m_place.xMm;
        const double y = v + m_skew * (u - m_place.xMm) + double(m_wander * noise.second) - m_place.yMm;
        return {float((m_cosine * x + m_sine * y) / m_pitchMm + m_centreX),
                float((-m_sine * x + m_cosine * y) / m_pitchMm + m_centreY)};
    }

    /// Place of a pixel on the fabric, without skew and displacement.
    cv::Point2d toFabric(double x, double y) const
    {
        const double right = (x - m_centreX) * m_pitchMm, down = (y - m_centreY) * m_pitchMm;
        return {m_place.xMm + m_cosine * right - m_sine * down, m_place.yMm + m_sine * right + m_cosine * down};
    }

    /// Extent of the threads that may be seen; `marginMm` is added on every side.
    ClothExtent extent(double marginMm) const
    {
        const double right = m_centreX * m_pitchMm, down = m_centreY * m_pitchMm;
        const double across = std::abs(m_cosine) * right + std::abs(m_sine) * down + marginMm + double(m_wander);
        const double along =
            std::abs(m_sine) * right + std::abs(m_cosine) * down + std::abs(m_skew) * across + marginMm + double(m_wander);
        return {m_place.xMm - across, m_place.xMm + across, m_place.yMm - along, m_place.yMm + along};
    }

private:
    FabricPlace m_place;
    double m_pitchMm, m_centreX, m_centreY, m_cosine, m_sine, m_skew;
    float m_wander, m_wanderLength;
    std::uint64_t m_seed;
};

}  // namespace rendering::fabrics
