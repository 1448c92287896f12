// Lattice of copies of a texture patch: the steps between copies, so that their overlapping strips agree, and the patch
// with blended strips.
#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

namespace rendering {

/// Offset of the next patch along an axis, so that its first strip lies on the last strip of this one.
struct TileStep {
    int strip = 0;   ///< width of the overlap, px
    int cut = 0;     ///< px at the patch's beginning that are left out
    int along = 0;   ///< distance from patch to patch, px
    int across = 0;  ///< sideways shift from patch to patch, px
    double correlation = 0;
};

/// Best step of `patch` along its columns (x). Every shift is compared, with at most 128 px cut away; the strip with the
/// highest correlation wins, with a preference for long steps. Sideways shifts of up to half a strip are tried if `mayShift`
/// (the other axis is tiled too). Returns nullopt for fewer than 16 columns.
std::optional<TileStep> stepAlongX(const cv::Mat& patch, bool mayShift);

/// Positions of the patches on a lattice, with one patch at `first`, that reach into a canvas.
std::vector<cv::Point> lattice(cv::Point first, cv::Size patch, cv::Size canvas, const TileStep& x, const TileStep& y);

/// The patch blended with its neighbours. It is the same for every copy, so it is computed once. The mean of two patches
/// that differ has less variance than each of them. `agreement` restores it within the patch's own range.
cv::Mat blended(const cv::Mat& patch, const TileStep& x, const TileStep& y, double agreement);

/// Row `row` of the copies of `laid` at `places`.
void layRow(std::vector<float>& target, const cv::Mat& laid, const std::vector<cv::Point>& places, int row);

}  // namespace rendering
