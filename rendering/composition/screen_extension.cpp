#include "rendering/composition/screen_extension.h"

#include <algorithm>
#include <opencv2/core.hpp>
#include <vector>

#include "rendering/composition/friction_image.h"
#include "rendering/composition/tiled_patch.h"

namespace rendering {

namespace {

cv::Mat mirrored(const cv::Mat& patch, cv::Size canvas)
{
    const int left = (canvas.width - patch.cols) / 2, top = (canvas.height - patch.rows) / 2;
    cv::Mat values;
    cv::copyMakeBorder(patch, values, top, canvas.height - patch.rows - top, left, canvas.width - patch.cols - left,
                       cv::BORDER_REFLECT);
    return values;
}

/// The map of a tiled patch on the screen.
cv::Mat joined(const TiledPatch& tiled)
{
    cv::Mat values(tiled.canvas, CV_32FC1);
    const auto columns = tiled.mirroredColumns();
    std::vector<float> texture(static_cast<std::size_t>(values.cols));
    for (int i = 0; i < values.rows; ++i)
        tiled.valuesOfRow(i, columns, texture, {values.ptr<float>(i), static_cast<std::size_t>(values.cols)});
    return values;
}

}  // namespace

Extended extendToScreen(const cv::Mat& patch, Extension extension)
{
    const cv::Size screen(displayWidthPx, displayHeightPx);
    const cv::Size kept(std::min(patch.cols, screen.width), std::min(patch.rows, screen.height));
    const cv::Mat inside =
        patch(cv::Rect((patch.cols - kept.width) / 2, (patch.rows - kept.height) / 2, kept.width, kept.height));
    if (kept == screen) return {inside.clone(), inside.size() == patch.size() ? "none" : "none (cropped)", 0};
    const bool isTrace = kept.height == 1;
    if (extension == Extension::Tile)
        if (const auto tiled = tiledPatch(inside)) {
            const cv::Mat values = joined(*tiled);
            return {isTrace ? cv::repeat(values, screen.height, 1) : values, "tile", tiled->agreement};
        }
    return {mirrored(inside, screen), extension == Extension::Mirror ? "mirror" : "mirror (too small or constant to tile)", 0};
}

}  // namespace rendering
