// The endless surface of one procedural fabric: relief in mm and yarn shade at any place.
//
// Woven: every yarn is a flattened cylinder that follows the draft. At each crossing its axis lies above or below
// the mid-plane by its share of the crimp. The shares add up to the two half heights, so crossing yarns touch.
// The axis passes smoothly between crossings and bows slightly along floats. The surface is the upper envelope of
// all yarns. Fibres are oblique ridges at the twist angle, hairiness is fine roughness. Lattice noise varies the
// position and thickness of yarns.
// Knitted: the loop curve x = w t/2pi + a sin 2t, y = h cos t, z = -d cos 2t. Its section is circular; it is drawn once per
// repeat. Face wales show their legs, back wales of a rib their heads. Corduroy: a plain ground with pile ribs. Waffle and
// crepe add cells that are larger than a yarn.
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>

#include "rendering/fabrics/procedural/structures.h"

namespace rendering::fabrics {

/// Centre of a picture on the fabric, and its rotation.
struct FabricPlace {
    double xMm = 0;
    double yMm = 0;
    double rotationDeg = 0;
};

/// Sampled piece of surface, CV_32FC1 each.
struct SurfacePatch {
    cv::Mat heightMm;  ///< height above the mid-plane of the fabric; may be negative
    cv::Mat shade;     ///< 1 for the mean reflectance of the yarn; less in gaps
};

class FabricSurface {
public:
    /// `seed` determines all irregularity: surfaces of one structure and seed are equal everywhere.
    FabricSurface(const Structure& structure, std::uint64_t seed);

    /// Samples `size` pixels of `pitchMm` around `place`.
    SurfacePatch sample(const FabricPlace& place, cv::Size size, double pitchMm) const;

    const Structure& structure() const { return *m_structure; }

private:
    struct SurfacePoint {
        float height;
        float shade;
    };
    SurfacePoint at(float u, float v) const;
    SurfacePoint wovenAt(float u, float v) const;
    SurfacePoint knittedAt(float u, float v) const;
    SurfacePoint withPile(SurfacePoint ground, float u, float v) const;
    SurfacePoint yarnAt(bool isWarp, std::int64_t yarn, float across, float along) const;
    float cellsAt(float u, float v) const;
    float axisHeight(bool isWarp, std::int64_t yarn, float along) const;

    const Structure* m_structure;
    std::uint64_t m_seed;
    float m_warpCrimp, m_weftCrimp;  ///< height of the axes above the mid-plane at a crossing, mm
    cv::Mat m_loops;                 ///< one repeat of a knit, height in mm
    double m_loopsWidthMm = 1, m_loopsHeightMm = 1;
};

}  // namespace rendering::fabrics
