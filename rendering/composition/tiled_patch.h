// A patch prepared for the screen: its texture on a lattice, its low-frequency parts, and the values of every row of the screen.
// screen_extension.h makes a map of it, frame_images.h a friction image.
#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>
#include <span>
#include <vector>

namespace rendering {

struct TiledPatch {
    cv::Mat patch;                  ///< CV_32FC1, shares the values of the caller
    cv::Mat slow, contrast;         ///< low-frequency part of the normalised patch, and contrast of its texture; of its size
    cv::Mat laid;                   ///< texture with blended strips
    std::vector<cv::Point> places;  ///< of the copies of `laid` on the canvas
    cv::Size canvas;
    cv::Rect unchanged;                               ///< part of the patch that no neighbour overlaps; may be empty
    cv::Point unchangedPlace;                         ///< of that part on the canvas
    float gain = 1, offset = 0, least = 0, most = 0;  ///< from the normalised patch to its own units, and their limits
    double agreement = 0;                             ///< correlation of overlapping strips

    /// Columns of the patch that the columns of the canvas show for the low-frequency parts, which are mirrored.
    std::vector<int> mirroredColumns() const;
    /// Values of row `row` of the canvas, in the units of the patch. `texture` is working memory of the canvas's width.
    void valuesOfRow(int row, const std::vector<int>& columns, std::vector<float>& texture, std::span<float> values) const;
};

/// `patch`: CV_32FC1, at most as large as the screen and smaller along one axis; a trace has one row. nullopt for a constant
/// patch, and for one of fewer than 16 pixels along an axis that must be extended.
std::optional<TiledPatch> tiledPatch(const cv::Mat& patch);

}  // namespace rendering
