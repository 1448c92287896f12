#include "rendering/composition/texture_lattice.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace rendering {

namespace {

constexpr int leastPatch = 16;         ///< px along an axis; below it there is no strip to compare
constexpr int longestCompared = 192;   ///< px of a strip's length, in its middle
constexpr int mostCut = 128;           ///< px; more would leave little to lay
constexpr double costOfCutting = 0.1;  ///< correlation that cutting the whole patch away must win

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

}  // namespace

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
