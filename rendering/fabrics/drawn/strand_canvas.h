// A height map onto which yarns, loops and tufts are laid as strands: sweeps of a flattened cross-section along a line.
// The highest strand is seen (upper envelope). For each point the canvas also keeps the direction of the fibres and the
// colour, which a camera needs.
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <span>

namespace rendering::fabrics {

/// One point of the axis of a strand, on the canvas.
struct StrandNode {
    float x = 0, y = 0;       ///< px
    float z = 0;              ///< height of the axis, mm
    float halfWidth = 1;      ///< px
    float halfHeight = 0.1f;  ///< mm
    float phase = 0;          ///< turns of the yarn since its start
    float shade = 1;          ///< relative brightness
    float turn = 0;           ///< the fibres lie aside from their usual angle, radians
    float colour[3] = {1, 1, 1};
};

struct StrandStyle {
    float twist = 0.4f;  ///< angle between fibres and axis, radians
    int plies = 1;
    float plyDepth = 0;        ///< depth of the grooves between plies, as a share of the half height
    float fibreDepth = 0;      ///< the same for fibres
    float fibreShade = 0.08f;  ///< variation of brightness between fibres
    bool isDome = false;       ///< true: the section is rounder and its edge is soft, as that of a tuft
    bool isBent = false;       ///< true: segments have round ends, for loops and curls
    std::uint64_t seed = 1;
};

/// CV_32FC1 each, of equal size; `colour` is CV_32FC3.
class StrandCanvas {
public:
    /// An empty ground at `groundMm`.
    StrandCanvas(cv::Size size, double pitchMm, float groundMm);

    void draw(std::span<const StrandNode> nodes, const StrandStyle& style);

    cv::Mat heightMm, tangentX, tangentY, tangentZ, shade, colour;

private:
    void drawSegment(const StrandNode& from, const StrandNode& to, const StrandStyle& style);

    float m_mmPerPixel;
};

}  // namespace rendering::fabrics
