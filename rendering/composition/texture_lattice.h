// How a texture continues itself: the steps by which copies of a patch are laid so that their overlapping
// strips agree, and the patch with those strips blended.
#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

namespace rendering {

/// Where the next patch along an axis begins, so that its first strip lies on this one's last.
struct Step {
    int strip = 0;   ///< width of the overlap, px
    int cut = 0;     ///< px of the patch's beginning that are not laid
    int along = 0;   ///< from patch to patch
    int across = 0;  ///< sideways shift from patch to patch
    double correlation = 0;
};

/// Of `patch` along its columns (x). Every shift is tried, cutting away at most 128 px; the best strip wins, longer
/// steps preferred. Sideways shifts, up to half a strip, only where the other axis is laid too. None for fewer than 16
/// columns.
std::optional<Step> stepAlongX(const cv::Mat& patch, bool mayShift);

/// Patches on the lattice of two steps, one of them at `first`, that reach into a canvas.
std::vector<cv::Point> lattice(cv::Point first, cv::Size patch, cv::Size canvas, const Step& x, const Step& y);

/// The patch with its neighbours blended in: the same wherever it is laid, so made once. Blending takes the mean of two
/// patches, whose variance is smaller the less they agree: made up for by `agreement`, within the patch's own range.
cv::Mat blended(const cv::Mat& patch, const Step& x, const Step& y, double agreement);

/// Row `row` of what is laid at `places`.
void layRow(std::vector<float>& target, const cv::Mat& laid, const std::vector<cv::Point>& places, int row);

}  // namespace rendering
