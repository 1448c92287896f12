#include "rendering/composition/screen_extension.h"

#include <algorithm>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "rendering/composition/friction_image.h"
#include "rendering/composition/texture_lattice.h"

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

/// Low-frequency part of a patch: three moving averages over a share of it. A large patch is reduced to every fourth row
/// and column first, which gives nearly the same result.
cv::Mat lowFrequencyPart(const cv::Mat& patch, int share)
{
    const bool large = std::min(patch.rows, patch.cols) >= 128;
    cv::Mat slow = patch;
    if (large) cv::resize(patch, slow, {patch.cols / 4, patch.rows / 4}, 0, 0, cv::INTER_AREA);
    const cv::Size width(slow.cols / share | 1, slow.rows / share | 1);
    for (int i = 0; i < 3; ++i) {
        cv::Mat next;
        cv::blur(slow, next, width, {-1, -1}, cv::BORDER_REFLECT);
        slow = next;
    }
    if (large) cv::resize(slow, slow, patch.size(), 0, 0, cv::INTER_LINEAR);
    return slow;
}

/// Conversion of a texture with standard deviation 1 to the patch's own units, and the limits of the patch's range.
struct Units {
    float gain = 1, offset = 0, least = 0, most = 0;
};

/// (slow + contrast * texture) in the patch's own units, row by row, because whole screens of intermediate results would cost
/// more than the sum. `slow` and `contrast` are as wide as the canvas and as high as the patch; they are mirrored where the
/// canvas is higher.
cv::Mat joined(const cv::Mat& slow, const cv::Mat& contrast, const cv::Mat& laid, const std::vector<cv::Point>& places,
               cv::Size canvas, const Units& units)
{
    cv::Mat values(canvas, CV_32FC1);
    std::vector<float> texture(static_cast<std::size_t>(canvas.width));
    const int top = (canvas.height - slow.rows) / 2;
    for (int i = 0; i < canvas.height; ++i) {
        layRow(texture, laid, places, i);
        const int own = cv::borderInterpolate(i - top, slow.rows, cv::BORDER_REFLECT);
        const float *level = slow.ptr<float>(own), *strength = contrast.ptr<float>(own), *fine = texture.data();
        float* value = values.ptr<float>(i);
        for (int j = 0; j < canvas.width; ++j) {
            const float sum = (level[j] + strength[j] * fine[j]) * units.gain + units.offset;
            value[j] = std::min(std::max(sum, units.least), units.most);
        }
    }
    return values;
}

/// A normalised patch (mean 0, standard deviation 1) as slow + contrast * texture. The shade of a fold and the
/// contrast of the weave change slowly; the texture is uniform.
struct TextureParts {
    cv::Mat slow, contrast, texture;
};

TextureParts partsOf(const cv::Mat& normal)
{
    constexpr double leastContrast = 0.05;  // Share of the whole deviation; a flatter area has no texture to extend.
    TextureParts parts{lowFrequencyPart(normal, 6), {}, {}};
    parts.texture = normal - parts.slow;
    cv::multiply(parts.texture, parts.texture, parts.contrast);
    parts.contrast = lowFrequencyPart(parts.contrast, 3);
    cv::max(parts.contrast, leastContrast * leastContrast, parts.contrast);
    cv::sqrt(parts.contrast, parts.contrast);
    cv::divide(parts.texture, parts.contrast, parts.texture);
    return parts;
}

/// Steps along x and y. Along an axis on which the patch fills the screen there is no step.
std::optional<std::pair<TileStep, TileStep>> stepsOf(const cv::Mat& texture, bool needsX, bool needsY)
{
    std::pair<TileStep, TileStep> steps{{.along = texture.cols}, {.along = texture.rows}};
    for (const bool alongX : {true, false}) {
        if (alongX ? !needsX : !needsY) continue;
        const auto found = stepAlongX(alongX ? texture : cv::Mat(texture.t()), needsX && needsY);
        if (!found) return {};
        (alongX ? steps.first : steps.second) = *found;
    }
    return steps;
}

/// Lays the texture on a lattice. Folds have no period and no copy fits the next one, so they are mirrored, which
/// gives no edge.
std::optional<Extended> tiled(const cv::Mat& patch)
{
    const cv::Size screen(displayWidthPx, displayHeightPx);
    const bool needsX = patch.cols < screen.width, needsY = patch.rows < screen.height && patch.rows > 1;
    cv::Scalar mean, sd;
    cv::meanStdDev(patch, mean, sd);
    if (!(sd[0] > 1e-30)) return {};  // 1 / sd must be a finite 32-bit number.
    // Normalised, so that heights of 1 nm and of 1 km give the same result.
    cv::Mat normal;
    patch.convertTo(normal, CV_32F, 1 / sd[0], -mean[0] / sd[0]);
    const TextureParts parts = partsOf(normal);
    const cv::Mat& texture = parts.texture;
    const auto steps = stepsOf(texture, needsX, needsY);
    if (!steps) return {};
    const auto& [x, y] = *steps;
    const cv::Rect kept(x.cut, y.cut, patch.cols - x.cut, patch.rows - y.cut);
    const double agreement = (x.correlation + y.correlation) / ((needsX ? 1 : 0) + (needsY ? 1 : 0));
    const cv::Mat laid = blended(texture(kept), x, y, agreement);
    const cv::Size canvas(screen.width, patch.rows > 1 ? screen.height : 1);
    const cv::Size wide(canvas.width, patch.rows);
    const cv::Point corner((canvas.width - patch.cols) / 2, (canvas.height - patch.rows) / 2);
    double least = 0, most = 0;
    cv::minMaxLoc(patch, &least, &most);
    cv::Mat values = joined(
        mirrored(parts.slow, wide), mirrored(parts.contrast, wide), laid, lattice(corner + kept.tl(), laid.size(), canvas, x, y),
        canvas, {static_cast<float>(sd[0]), static_cast<float>(mean[0]), static_cast<float>(least), static_cast<float>(most)});
    // Copy the source bit by bit where no neighbour overlaps it. Slanted neighbours reach half a strip further.
    const int marginX = x.strip + x.strip / 2, marginY = y.strip + y.strip / 2;
    const cv::Rect inside(marginX, marginY, kept.width - 2 * marginX, kept.height - 2 * marginY);
    if (inside.width > 0 && inside.height > 0) patch(kept)(inside).copyTo(values(inside + corner + kept.tl()));
    return Extended{values, "tile", agreement};
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
        if (auto laid = tiled(inside)) {
            if (isTrace) laid->values = cv::repeat(laid->values, screen.height, 1);
            return *laid;
        }
    return {mirrored(inside, screen), extension == Extension::Mirror ? "mirror" : "mirror (too small or constant to tile)", 0};
}

}  // namespace rendering
