#include "rendering/composition/texture_lattice.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace rendering {

namespace {

constexpr int leastPatch = 16;         ///< px along an axis; smaller patches have no strip to compare
constexpr int longestCompared = 192;   ///< px of a strip that are compared, in its middle
constexpr int mostCut = 128;           ///< px; cutting more would leave too little to lay
constexpr double costOfCutting = 0.1;  ///< gain of correlation that would justify cutting the whole patch

/// Weights that rise from 0 to 1 over a strip at either end, so that two patches at one step add up to 1.
cv::Mat ramps(int length, int strip)
{
    cv::Mat weights = cv::Mat::ones(length, 1, CV_32FC1);
    for (int i = 0; i < strip; ++i) {
        const double rise = std::pow(std::sin(std::numbers::pi * (i + 0.5) / (2 * strip)), 2);
        weights.at<float>(i) = weights.at<float>(length - 1 - i) = static_cast<float>(rise);
    }
    return weights;
}

/// column * row^T. OpenCV's own product wakes the threads of a linear algebra library, which costs far more than this.
cv::Mat productOf(const cv::Mat& column, const cv::Mat& row)
{
    cv::Mat product(column.rows, row.rows, CV_32FC1);
    for (int i = 0; i < product.rows; ++i)
        for (int j = 0; j < product.cols; ++j) product.at<float>(i, j) = column.at<float>(i) * row.at<float>(j);
    return product;
}

/// Overlap of a patch and a canvas, as rectangles in both; empty where there is none.
struct PatchOverlap {
    cv::Rect onCanvas, ofPatch;
};

PatchOverlap overlapOf(cv::Size patch, cv::Point place, cv::Size canvas)
{
    const cv::Rect common = cv::Rect(place, patch) & cv::Rect(cv::Point(), canvas);
    return {common, common.empty() ? cv::Rect() : common - place};
}

/// Restores the variance of the blended sum. The mean of two patches that differ has less variance than each of them. The
/// result is limited to the patch's own range.
void restoreContrast(cv::Mat& sum, const cv::Mat& weight, const cv::Mat& squares, double agreement, float least, float most)
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

}  // namespace

std::optional<TileStep> stepAlongX(const cv::Mat& patch, bool mayShift)
{
    if (patch.cols < leastPatch) return {};
    TileStep step;
    step.strip = std::clamp(patch.cols / 8, 4, 48);
    // At most half a strip sideways, because larger shifts would leave gaps at the corners of the patches.
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

std::vector<cv::Point> lattice(cv::Point first, cv::Size patch, cv::Size canvas, const TileStep& x, const TileStep& y)
{
    std::vector<cv::Point> places;
    const int columns = canvas.width / x.along + 2, rows = canvas.height / y.along + 2;
    // A slanted lattice leaves the canvas sideways; these additional columns and rows cover it again.
    const int moreColumns = 2 + rows * std::abs(y.across) / x.along, moreRows = 2 + columns * std::abs(x.across) / y.along;
    for (int i = -columns - moreColumns; i <= columns + moreColumns; ++i)
        for (int j = -rows - moreRows; j <= rows + moreRows; ++j) {
            const cv::Point place(first.x + i * x.along + j * y.across, first.y + j * y.along + i * x.across);
            if (!overlapOf(patch, place, canvas).onCanvas.empty()) places.push_back(place);
        }
    return places;
}

cv::Mat blended(const cv::Mat& patch, const TileStep& x, const TileStep& y, double agreement)
{
    const cv::Mat window = productOf(ramps(patch.rows, y.strip), ramps(patch.cols, x.strip));
    cv::Mat sum = cv::Mat::zeros(patch.size(), CV_32FC1), weight = sum.clone(), squares = sum.clone();
    for (const cv::Point place : lattice({}, patch.size(), patch.size(), x, y)) {
        const PatchOverlap overlap = overlapOf(patch.size(), place, patch.size());
        for (int i = 0; i < overlap.onCanvas.height; ++i) {
            const int row = overlap.onCanvas.y + i, from = overlap.ofPatch.y + i;
            const float *value = patch.ptr<float>(from) + overlap.ofPatch.x, *w = window.ptr<float>(from) + overlap.ofPatch.x;
            float *s = sum.ptr<float>(row) + overlap.onCanvas.x, *t = weight.ptr<float>(row) + overlap.onCanvas.x,
                  *q = squares.ptr<float>(row) + overlap.onCanvas.x;
            for (int j = 0; j < overlap.onCanvas.width; ++j) {
                s[j] += w[j] * value[j];
                t[j] += w[j];
                q[j] += w[j] * w[j];
            }
        }
    }
    double least = 0, most = 0;
    cv::minMaxLoc(patch, &least, &most);
    restoreContrast(sum, weight, squares, agreement, static_cast<float>(least), static_cast<float>(most));
    return sum;
}

void layRow(std::vector<float>& target, const cv::Mat& laid, const std::vector<cv::Point>& places, int row)
{
    for (const cv::Point place : places) {
        const int own = row - place.y;
        if (own < 0 || own >= laid.rows) continue;
        const int from = std::max(place.x, 0), to = std::min(place.x + laid.cols, static_cast<int>(target.size()));
        std::copy_n(laid.ptr<float>(own) + (from - place.x), std::max(to - from, 0), target.begin() + from);
    }
}

}  // namespace rendering
