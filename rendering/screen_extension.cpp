#include "rendering/screen_extension.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <vector>

#include "rendering/friction_image.h"

namespace rendering {

namespace {

constexpr int leastPatch = 16;         ///< px along an axis; below it there is no strip to compare
constexpr int longestCompared = 192;   ///< px of a strip's length, in its middle
constexpr int mostCut = 128;           ///< px; more would leave little to lay
constexpr double costOfCutting = 0.1;  ///< correlation that cutting the whole patch away must win

/// Where the next patch along an axis begins, so that its first strip lies on this one's last.
struct Step {
    int strip = 0;   ///< width of the overlap, px
    int cut = 0;     ///< px of the patch's beginning that are not laid
    int along = 0;   ///< from patch to patch
    int across = 0;  ///< sideways shift from patch to patch
    double correlation = 0;
};

/// Of `patch` along its columns (x). Every shift is tried; the best strip wins, longer steps preferred.
/// Sideways only where the other axis is laid too.
std::optional<Step> stepAlongX(const cv::Mat& patch, bool mayShift)
{
    if (patch.cols < leastPatch) return {};
    Step step;
    step.strip = std::clamp(patch.cols / 8, 4, 48);
    // Up to half a strip sideways: further, the patches' corners would leave gaps.
    const int sideways = mayShift ? std::min(step.strip / 2, patch.rows / 4) : 0;
    const int length = std::min(patch.rows - 2 * sideways, longestCompared), top = (patch.rows - length) / 2;
    const cv::Mat last = patch(cv::Rect(patch.cols - step.strip, top, step.strip, length));
    const cv::Mat beginning =
        patch(cv::Rect(0, top - sideways, std::min(patch.cols / 2, step.strip + mostCut), length + 2 * sideways));
    cv::Mat agreement;
    cv::matchTemplate(beginning, last, agreement, cv::TM_CCOEFF_NORMED);
    double best = -2;
    for (int y = 0; y < agreement.rows; ++y)
        for (int x = 0; x < agreement.cols; ++x) {
            const double score = agreement.at<float>(y, x) - costOfCutting * x / patch.cols;
            if (!(score > best)) continue;
            best = score;
            step.cut = x;
            step.across = sideways - y;
            step.correlation = agreement.at<float>(y, x);
        }
    step.along = patch.cols - step.strip - step.cut;
    if (best <= -2) return {};
    return step;
}

/// 0 to 1 over a strip at either end, so that two of them a step apart add up to 1.
cv::Mat ramps(int length, int strip)
{
    cv::Mat weights = cv::Mat::ones(length, 1, CV_32FC1);
    for (int i = 0; i < strip; ++i) {
        const double rise = std::pow(std::sin(std::numbers::pi * (i + 0.5) / (2 * strip)), 2);
        weights.at<float>(i) = weights.at<float>(length - 1 - i) = static_cast<float>(rise);
    }
    return weights;
}

/// The part of a patch at `place` that lies on a canvas, and where there; empty where none does.
struct Seen {
    cv::Rect onCanvas, ofPatch;
};

Seen seenOf(cv::Size patch, cv::Point place, cv::Size canvas)
{
    const cv::Rect seen = cv::Rect(place, patch) & cv::Rect(cv::Point(), canvas);
    return {seen, seen.empty() ? cv::Rect() : seen - place};
}

/// Patches on the lattice of two steps, one of them at `first`, that reach into a canvas.
std::vector<cv::Point> lattice(cv::Point first, cv::Size patch, cv::Size canvas, const Step& x, const Step& y)
{
    std::vector<cv::Point> places;
    const int columns = canvas.width / x.along + 2, rows = canvas.height / y.along + 2;
    // A slanted lattice leaves the canvas sideways: so many more columns and rows bring it back.
    const int moreColumns = 2 + rows * std::abs(y.across) / x.along, moreRows = 2 + columns * std::abs(x.across) / y.along;
    for (int i = -columns - moreColumns; i <= columns + moreColumns; ++i)
        for (int j = -rows - moreRows; j <= rows + moreRows; ++j) {
            const cv::Point place(first.x + i * x.along + j * y.across, first.y + j * y.along + i * x.across);
            if (!seenOf(patch, place, canvas).onCanvas.empty()) places.push_back(place);
        }
    return places;
}

/// Blending takes the mean of two patches, whose variance is smaller the less they agree: made up for, within
/// the patch's own range.
void settle(cv::Mat& sum, const cv::Mat& weight, const cv::Mat& squares, double agreement, float least, float most)
{
    const auto correlation = static_cast<float>(std::clamp(agreement, 0.0, 1.0));
    for (int i = 0; i < sum.rows; ++i) {
        float* value = sum.ptr<float>(i);
        const float *w = weight.ptr<float>(i), *w2 = squares.ptr<float>(i);
        for (int j = 0; j < sum.cols; ++j) {
            const float share = w2[j] / (w[j] * w[j]);
            const float kept = std::sqrt(share + correlation * (1 - share));
            value[j] = std::min(std::max(value[j] / (w[j] * kept), least), most);
        }
    }
}

/// The patch with its neighbours blended in: the same wherever it is laid, so made once.
cv::Mat blended(const cv::Mat& patch, const Step& x, const Step& y, double agreement)
{
    const cv::Mat window = ramps(patch.rows, y.strip) * ramps(patch.cols, x.strip).t();
    cv::Mat sum = cv::Mat::zeros(patch.size(), CV_32FC1), weight = sum.clone(), squares = sum.clone();
    for (const cv::Point place : lattice({}, patch.size(), patch.size(), x, y)) {
        const Seen seen = seenOf(patch.size(), place, patch.size());
        for (int i = 0; i < seen.onCanvas.height; ++i) {
            const int row = seen.onCanvas.y + i, from = seen.ofPatch.y + i;
            const float *value = patch.ptr<float>(from) + seen.ofPatch.x, *w = window.ptr<float>(from) + seen.ofPatch.x;
            float *s = sum.ptr<float>(row) + seen.onCanvas.x, *t = weight.ptr<float>(row) + seen.onCanvas.x,
                  *q = squares.ptr<float>(row) + seen.onCanvas.x;
            for (int j = 0; j < seen.onCanvas.width; ++j) {
                s[j] += w[j] * value[j];
                t[j] += w[j];
                q[j] += w[j] * w[j];
            }
        }
    }
    double least = 0, most = 0;
    cv::minMaxLoc(patch, &least, &most);
    settle(sum, weight, squares, agreement, static_cast<float>(least), static_cast<float>(most));
    return sum;
}

cv::Mat mirrored(const cv::Mat& patch, cv::Size canvas)
{
    const int left = (canvas.width - patch.cols) / 2, top = (canvas.height - patch.rows) / 2;
    cv::Mat values;
    cv::copyMakeBorder(patch, values, top, canvas.height - patch.rows - top, left, canvas.width - patch.cols - left,
                       cv::BORDER_REFLECT);
    return values;
}

/// Three running means over a share of the patch: what is wider than about that. Of a large patch a quarter of
/// the pixels say as much.
cv::Mat slowPart(const cv::Mat& patch, int share)
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

/// Row `row` of the texture that is laid at `places`.
void layRow(std::vector<float>& texture, const cv::Mat& laid, const std::vector<cv::Point>& places, int row)
{
    for (const cv::Point place : places) {
        const int own = row - place.y;
        if (own < 0 || own >= laid.rows) continue;
        const int from = std::max(place.x, 0), to = std::min(place.x + laid.cols, static_cast<int>(texture.size()));
        std::copy_n(laid.ptr<float>(own) + (from - place.x), std::max(to - from, 0), texture.begin() + from);
    }
}

/// What makes a texture of spread 1 the patch's own again, and keeps it within the patch's range.
struct Units {
    float gain = 1, offset = 0, least = 0, most = 0;
};

/// (slow + contrast * texture) in the patch's own units, row by row: a screen of texture in between would cost more
/// than the sum.
void addTexture(cv::Mat& slow, const cv::Mat& contrast, const cv::Mat& laid, const std::vector<cv::Point>& places,
                const Units& units)
{
    std::vector<float> texture(static_cast<std::size_t>(slow.cols));
    for (int i = 0; i < slow.rows; ++i) {
        layRow(texture, laid, places, i);
        float* value = slow.ptr<float>(i);
        const float *fine = texture.data(), *strength = contrast.ptr<float>(i);
        for (int j = 0; j < slow.cols; ++j) {
            const float sum = (value[j] + strength[j] * fine[j]) * units.gain + units.offset;
            value[j] = std::min(std::max(sum, units.least), units.most);
        }
    }
}

/// A patch about its mean and of spread 1 as slow + contrast * texture: a fold's shade and how strongly the weave
/// shows in it change slowly, the texture is everywhere alike.
struct Parts {
    cv::Mat slow, contrast, texture;
};

Parts partsOf(const cv::Mat& normal)
{
    constexpr double leastContrast = 0.05;  // of the spread of the whole: what is flatter has no texture to lay
    Parts parts{slowPart(normal, 6), {}, {}};
    parts.texture = normal - parts.slow;
    cv::multiply(parts.texture, parts.texture, parts.contrast);
    parts.contrast = slowPart(parts.contrast, 3);
    cv::max(parts.contrast, leastContrast * leastContrast, parts.contrast);
    cv::sqrt(parts.contrast, parts.contrast);
    cv::divide(parts.texture, parts.contrast, parts.texture);
    return parts;
}

/// The texture is laid on a lattice. Folds have no direction to keep and never meet themselves: they are mirrored,
/// which joins them without an edge.
std::optional<Extended> tiled(const cv::Mat& patch)
{
    const cv::Size screen(displayWidthPx, displayHeightPx);
    const bool needsX = patch.cols < screen.width, needsY = patch.rows < screen.height && patch.rows > 1;
    cv::Scalar mean, sd;
    cv::meanStdDev(patch, mean, sd);
    if (!(sd[0] > 1e-30)) return {};  // 1 / sd must be a number of 32 bits
    // About its mean and of spread 1: heights of 1 nm and of 1 km are laid alike.
    cv::Mat normal;
    patch.convertTo(normal, CV_32F, 1 / sd[0], -mean[0] / sd[0]);
    const Parts parts = partsOf(normal);
    const cv::Mat& texture = parts.texture;
    Step x{.along = patch.cols}, y{.along = patch.rows};
    for (const bool alongX : {true, false}) {
        if (alongX ? !needsX : !needsY) continue;
        const auto found = stepAlongX(alongX ? texture : cv::Mat(texture.t()), needsX && needsY);
        if (!found) return {};
        (alongX ? x : y) = *found;
    }
    const cv::Rect kept(x.cut, y.cut, patch.cols - x.cut, patch.rows - y.cut);
    const double agreement = (x.correlation + y.correlation) / ((needsX ? 1 : 0) + (needsY ? 1 : 0));
    const cv::Mat laid = blended(texture(kept), x, y, agreement);
    const cv::Size canvas(screen.width, patch.rows > 1 ? screen.height : 1);
    cv::Mat values = mirrored(parts.slow, canvas);
    const cv::Point corner((screen.width - patch.cols) / 2, (values.rows - patch.rows) / 2);
    double least = 0, most = 0;
    cv::minMaxLoc(patch, &least, &most);
    addTexture(values, mirrored(parts.contrast, canvas), laid, lattice(corner + kept.tl(), laid.size(), values.size(), x, y),
               {static_cast<float>(sd[0]), static_cast<float>(mean[0]), static_cast<float>(least), static_cast<float>(most)});
    // What no neighbour reaches is the source itself, bit by bit. Slanted neighbours reach half a strip further.
    const int marginX = x.strip + x.strip / 2, marginY = y.strip + y.strip / 2;
    const cv::Rect inside(marginX, marginY, kept.width - 2 * marginX, kept.height - 2 * marginY);
    if (inside.width > 0 && inside.height > 0) patch(kept)(inside).copyTo(values(inside + corner + kept.tl()));
    return Extended{values, "tile", agreement};
}

}  // namespace

Extended overScreen(const cv::Mat& patch, Extension extension)
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
