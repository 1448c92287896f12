// The endless surface of one procedural fabric: relief in mm and yarn shade at any place.
//
// Woven: every yarn is a flattened cylinder that follows the draft; at each crossing its axis lies
// above or below the mid-plane by its share of the crimp (the shares add up to the two half heights,
// so that crossing yarns touch), with a smooth passage between crossings and a slight bow along
// floats. The surface is the upper envelope of all warps and wefts. Fibres show as oblique ridges at
// the twist angle, hairiness as fine roughness. Yarns wander and change thickness by lattice noise.
// Knitted: a loop curve x = w t/2pi + a sin 2t, y = h cos t, z = -d cos 2t with a circular section,
// drawn once per repeat; face wales show their legs, back wales of a rib their heads.
// Corduroy: a plain ground with pile ribs. Waffle and crepe add cells above the size of a yarn.
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>

#include "rendering/fabrics/procedural/structures.h"

namespace rendering::fabrics {

/// Where on the fabric and how turned: the centre of the picture, mm, and its rotation.
struct Place {
    double xMm = 0;
    double yMm = 0;
    double rotationDeg = 0;
};

/// A sampled piece of surface, CV_32FC1 each.
struct SurfacePatch {
    cv::Mat heightMm;  ///< above the mid-plane of the fabric; may be negative
    cv::Mat shade;     ///< 1 for the yarn's mean reflectance; less in gaps
};

class FabricSurface {
public:
    /// `seed` sets all irregularity; two surfaces of one structure and seed are equal everywhere.
    FabricSurface(const Structure& structure, std::uint64_t seed);

    /// Samples `size` pixels of `pitchMm` around `place`.
    SurfacePatch sample(const Place& place, cv::Size size, double pitchMm) const;

    const Structure& structure() const { return *m_structure; }

private:
    struct Point {
        float height;
        float shade;
    };
    Point at(float u, float v) const;
    Point wovenAt(float u, float v) const;
    Point knittedAt(float u, float v) const;
    Point withPile(Point ground, float u, float v) const;
    Point yarnAt(bool isWarp, std::int64_t yarn, float across, float along) const;
    float cellsAt(float u, float v) const;
    float axisHeight(bool isWarp, std::int64_t yarn, float along) const;

    const Structure* m_structure;
    std::uint64_t m_seed;
    float m_warpCrimp, m_weftCrimp;  ///< height of the axes over the mid-plane at a crossing, mm
    cv::Mat m_loops;                 ///< one repeat of a knit, height mm
    double m_loopsWidthMm = 1, m_loopsHeightMm = 1;
};

}  // namespace rendering::fabrics
