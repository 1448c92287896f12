#include "rendering/fabrics/procedural/loop_tile.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rendering::fabrics {

namespace {

constexpr double tilePitchMm = 0.0125;

/// Raises the tile to the upper half of a sphere; the tile is periodic.
void raiseSphere(cv::Mat& tile, double x, double y, double z, double radius, double flatness)
{
    const int reach = int(std::ceil(radius / tilePitchMm));
    const int column = int(std::floor(x / tilePitchMm));
    const int row = int(std::floor(y / tilePitchMm));
    for (int dy = -reach; dy <= reach; ++dy)
        for (int dx = -reach; dx <= reach; ++dx) {
            const double offX = (column + dx) * tilePitchMm - x;
            const double offY = (row + dy) * tilePitchMm - y;
            const double rest = radius * radius - offX * offX - offY * offY;
            if (rest <= 0) continue;
            float& height = tile.at<float>(((row + dy) % tile.rows + tile.rows) % tile.rows,
                                           ((column + dx) % tile.cols + tile.cols) % tile.cols);
            height = std::max(height, float(z + flatness * std::sqrt(rest)));
        }
}

}  // namespace

LoopTile drawLoops(const Structure& structure)
{
    const bool rib = structure.construction == Construction::Rib;
    const int wales = rib ? 4 : 1;
    const double wale = structure.warp.spacing;
    const double course = structure.weft.spacing;
    const double radius = structure.warp.diameter / 2;
    LoopTile tile;
    tile.widthMm = wales * wale;
    tile.lengthMm = course;
    tile.heightMm = cv::Mat(int(std::lround(course / tilePitchMm)), int(std::lround(tile.widthMm / tilePitchMm)), CV_32FC1,
                            cv::Scalar(-radius * 1.6));
    const double lobe = 0.21 * wale;     // Makes the loop's head wider than its neck.
    const double reach = 0.95 * course;  // Heads lie behind the feet of the next course.
    const double depth = 0.75 * radius;
    constexpr int steps = 1200;
    for (int k = 0; k < wales; ++k) {
        const double side = rib && k >= 2 ? -1 : 1;
        const double level = rib ? side * structure.cells.depth / 2 : 0;
        for (int step = 0; step < steps; ++step) {
            const double t = 2 * std::numbers::pi * step / steps;
            const double x = (k + t / (2 * std::numbers::pi)) * wale + lobe * std::sin(2 * t);
            const double y = reach * std::cos(t);
            const double z = level - side * depth * std::cos(2 * t);
            raiseSphere(tile.heightMm, x, y, z, radius, structure.warp.flatness);
        }
    }
    return tile;
}

}  // namespace rendering::fabrics
