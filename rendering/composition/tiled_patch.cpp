#include "rendering/composition/tiled_patch.h"

#include <algorithm>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "rendering/composition/friction_image.h"
#include "rendering/composition/texture_lattice.h"

namespace rendering {

namespace {

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

}  // namespace

std::vector<int> TiledPatch::mirroredColumns() const
{
    const int left = (canvas.width - slow.cols) / 2;
    std::vector<int> columns(static_cast<std::size_t>(canvas.width));
    for (int j = 0; j < canvas.width; ++j)
        columns[static_cast<std::size_t>(j)] = cv::borderInterpolate(j - left, slow.cols, cv::BORDER_REFLECT);
    return columns;
}

void TiledPatch::valuesOfRow(int row, const std::vector<int>& columns, std::vector<float>& texture, std::span<float> values) const
{
    layRow(texture, laid, places, row);
    const int own = cv::borderInterpolate(row - (canvas.height - slow.rows) / 2, slow.rows, cv::BORDER_REFLECT);
    const float *level = slow.ptr<float>(own), *strength = contrast.ptr<float>(own);
    for (std::size_t j = 0; j < values.size(); ++j) {
        const auto column = static_cast<std::size_t>(columns[j]);
        const float sum = (level[column] + strength[column] * texture[j]) * gain + offset;
        values[j] = std::min(std::max(sum, least), most);
    }
    // The source stays bit by bit where no neighbour overlaps it.
    const int inside = row - unchangedPlace.y;
    if (inside < 0 || inside >= unchanged.height) return;
    std::copy_n(patch.ptr<float>(unchanged.y + inside) + unchanged.x, unchanged.width, values.begin() + unchangedPlace.x);
}

/// Folds have no period and no copy fits the next one, so they are mirrored, which gives no edge.
std::optional<TiledPatch> tiledPatch(const cv::Mat& patch)
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
    const auto steps = stepsOf(parts.texture, needsX, needsY);
    if (!steps) return {};
    const auto& [x, y] = *steps;
    const cv::Rect kept(x.cut, y.cut, patch.cols - x.cut, patch.rows - y.cut);
    TiledPatch tiled;
    tiled.patch = patch;
    tiled.slow = parts.slow;
    tiled.contrast = parts.contrast;
    tiled.agreement = (x.correlation + y.correlation) / ((needsX ? 1 : 0) + (needsY ? 1 : 0));
    tiled.laid = blended(parts.texture(kept), x, y, tiled.agreement);
    tiled.canvas = cv::Size(screen.width, patch.rows > 1 ? screen.height : 1);
    const cv::Point corner((tiled.canvas.width - patch.cols) / 2, (tiled.canvas.height - patch.rows) / 2);
    tiled.places = lattice(corner + kept.tl(), tiled.laid.size(), tiled.canvas, x, y);
    // Slanted neighbours reach half a strip further.
    const int marginX = x.strip + x.strip / 2, marginY = y.strip + y.strip / 2;
    const cv::Rect inside(kept.x + marginX, kept.y + marginY, kept.width - 2 * marginX, kept.height - 2 * marginY);
    if (inside.width > 0 && inside.height > 0) {
        tiled.unchanged = inside;
        tiled.unchangedPlace = corner + inside.tl();
    }
    double least = 0, most = 0;
    cv::minMaxLoc(patch, &least, &most);
    tiled.gain = static_cast<float>(sd[0]);
    tiled.offset = static_cast<float>(mean[0]);
    tiled.least = static_cast<float>(least);
    tiled.most = static_cast<float>(most);
    return tiled;
}

}  // namespace rendering
