#include "rendering/signals/gap_multigrid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/core.hpp>
#include <string>

#include "protocols/files/errors.h"
#include "protocols/files/number_text.h"
#include "rendering/signals/gaps/multigrid.h"
#include "rendering/signals/gaps/row_work.h"
#include "rendering/signals/slope_differences.h"

namespace rendering::signals {

namespace {

/// Ratio of the weights of the two directions (pixels 8 times as long as wide). Beyond it, smoothing point by point is too slow.
constexpr double mostUneven = 64;
constexpr int mostTransformSteps = 2000;  ///< the worst map that was tried, 30 % missing at a pitch of 30:1, needed 800
constexpr double largestResidual = 1e-4;

double dot(const float* a, const float* b, int length)
{
    double sum = 0;
    for (int j = 0; j < length; ++j) sum += static_cast<double>(a[j]) * static_cast<double>(b[j]);
    return sum;
}

double dot(const cv::Mat& a, const cv::Mat& b)
{
    return sumOfRows(a.rows, [&](int i) { return dot(a.ptr<float>(i), b.ptr<float>(i), a.cols); });
}

/// Conjugate gradients from `height`; `residual` belongs to it.
void improve(cv::Mat& height, cv::Mat& residual, Multigrid& grids, double residualToReach, int mostIterations)
{
    const int rows = residual.rows, columns = residual.cols;
    cv::Mat direction = cv::Mat::zeros(residual.size(), CV_32FC1), change = direction.clone();
    double power = 0, length = 0;
    for (int k = 0; k < mostIterations && dot(residual, residual) > residualToReach; ++k) {
        const cv::Mat& step = grids.cycle(residual);
        // Slopes do not contain the mean. In single precision, a mean that grows from step to step would hide the shape.
        const auto mean = static_cast<float>(cv::mean(step)[0]);
        // Single precision leaves the cycle not quite symmetric; this form of the factor tolerates that.
        const auto keep = power > 0 ? static_cast<float>(-length * dot(step, change) / power) : 0.F;
        power = dot(residual, step);
        forRows(rows, [&](int i) {
            float* d = direction.ptr<float>(i);
            const float* s = step.ptr<float>(i);
            for (int j = 0; j < columns; ++j) d[j] = s[j] - mean + keep * d[j];
        });
        const double curvature = sumOfRows(rows, [&](int i) {
            multiplyRow(grids.finest(), direction, i, change.ptr<float>(i));
            return dot(change.ptr<float>(i), direction.ptr<float>(i), columns);
        });
        if (!(curvature > 0)) return;
        length = dot(residual, direction) / curvature;
        forRows(rows, [&](int i) {
            const float *d = direction.ptr<float>(i), *c = change.ptr<float>(i);
            double* h = height.ptr<double>(i);
            float* r = residual.ptr<float>(i);
            for (int j = 0; j < columns; ++j) {
                h[j] += length * static_cast<double>(d[j]);
                r[j] -= static_cast<float>(length) * c[j];
            }
        });
    }
}

/// Product of the normal matrix and `height`, CV_64FC1.
cv::Mat pullsOf(const Slopes& weights, const cv::Mat& height)
{
    cv::Mat result(height.size(), CV_64FC1);
    const auto pullOf = [](float weight, double here, double there) { return static_cast<double>(weight) * (here - there); };
    forRows(height.rows, [&](int i) {
        const double *here = height.ptr<double>(i), *upper = height.ptr<double>(std::max(0, i - 1)),
                     *lower = height.ptr<double>(std::min(i + 1, height.rows - 1));
        const float *right = weights.x.ptr<float>(i), *below = weights.y.ptr<float>(i),
                    *above = weights.y.ptr<float>(std::max(0, i - 1));
        double* out = result.ptr<double>(i);
        for (int j = 0; j < height.cols; ++j) out[j] = pullOf(below[j], here[j], lower[j]) + pullOf(above[j], here[j], upper[j]);
        for (int j = 0; j + 1 < height.cols; ++j) {
            const double pull = pullOf(right[j], here[j], here[j + 1]);
            out[j] += pull;
            out[j + 1] -= pull;
        }
    });
    return result;
}

/// Residual of `height` in double precision.
cv::Mat residualOf(const WeightedRises& rises, const cv::Mat& height)
{
    cv::Mat result = pullsOf(rises.weights, height);
    cv::subtract(rises.sources, result, result, cv::noArray(), CV_64F);
    return result;
}

double largestOf(const cv::Mat& weights)
{
    double largest = 0;
    cv::minMaxLoc(weights, nullptr, &largest);
    return std::max<double>(largest, std::numeric_limits<float>::min());
}

template <class Use>
void forWeights(const cv::Mat& weights, Use use)
{
    for (int i = 0; i < weights.rows; ++i)
        for (const float *weight = weights.ptr<float>(i), *end = weight + weights.cols; weight != end; ++weight)
            if (*weight > 0) use(static_cast<double>(*weight));
}

double smallestOf(const cv::Mat& weights)
{
    double smallest = std::numeric_limits<float>::max();
    forWeights(weights, [&](double weight) { smallest = std::min(smallest, weight); });
    return smallest;
}

/// Geometric mean: neither a few measured slopes among gaps nor a few gaps decide it.
double typicalOf(const cv::Mat& weights)
{
    double sum = 0, count = 0;
    forWeights(weights, [&](double weight) {
        sum += std::log(weight);
        ++count;
    });
    return count > 0 ? std::exp(sum / count) : 1;
}

/// Factor, at least 1, by which the weights of one direction exceed those of the other. Where one direction lacks measured
/// slopes, only the weights of gaps show how long the pixels are.
double unevennessOf(const Slopes& weights)
{
    const auto factor = [](double x, double y) { return std::max(x / y, y / x); };
    return std::min(factor(largestOf(weights.x), largestOf(weights.y)), factor(smallestOf(weights.x), smallestOf(weights.y)));
}

/// Conjugate gradients in double precision from `height`. The cosine transform solves the equations of even weights. The more the
/// weights differ, and the larger their map is, the more steps follow: up to several hundred.
void improveByTransform(cv::Mat& height, const WeightedRises& rises, double residualToReach)
{
    const Pitch pitch{1 / std::sqrt(typicalOf(rises.weights.x)), 1 / std::sqrt(typicalOf(rises.weights.y))};
    const SlopeDifferences<double> even(height.size(), pitch, SlopeKind::Forward);
    cv::Mat residual, direction;
    rises.sources.convertTo(residual, CV_64F);
    // Residuals hardly show long waves, nor rises along the longer side of a pixel; energies do.
    const double share = residualToReach * residualToReach, length = share * residual.dot(residual),
                 squared = largestOf(rises.weights.x) / largestOf(rises.weights.y),
                 energy = share * std::min(squared, 1 / squared) * residual.dot(even.surfaceOf(residual));
    residual = residualOf(rises, height);
    double power = 0;
    for (int k = 0; k < mostTransformSteps; ++k) {
        cv::Mat step = even.surfaceOf(residual);
        const double next = residual.dot(step);
        if (next <= energy && residual.dot(residual) <= length) return;
        if (power > 0) cv::scaleAdd(direction, next / power, step, step);
        direction = step;
        power = next;
        const cv::Mat change = pullsOf(rises.weights, direction);
        const double curvature = direction.dot(change);
        if (!(curvature > 0)) return;
        cv::scaleAdd(direction, next / curvature, height, height);
        cv::scaleAdd(change, -next / curvature, residual, residual);
    }
}

/// In a single row or column each pull follows from the one before.
cv::Mat summed(const WeightedRises& rises)
{
    const cv::Mat& weights = rises.sources.rows == 1 ? rises.weights.x : rises.weights.y;
    cv::Mat height = cv::Mat::zeros(rises.sources.size(), CV_64FC1), sources;
    rises.sources.convertTo(sources, CV_64F);
    double pull = 0;
    for (int k = 0; k + 1 < static_cast<int>(height.total()); ++k) {
        const auto weight = static_cast<double>(weights.at<float>(k));
        pull = weight > 0 ? pull - sources.at<double>(k) : 0;
        height.at<double>(k + 1) = height.at<double>(k) + (weight > 0 ? pull / weight : 0);
    }
    return height;
}

}  // namespace

cv::Mat surfaceOfWeightedRises(const WeightedRises& rises, const MultigridOptions& options)
{
    cv::Mat height = cv::Mat::zeros(rises.sources.size(), CV_64FC1), residual;
    rises.sources.convertTo(residual, CV_32F);
    const double all = dot(residual, residual);
    if (!std::isfinite(all))
        throw protocols::badInput({.what = "the slopes around the gaps exceed the range of 32-bit numbers",
                                   .where = "",
                                   .expected = "slopes in mm/mm",
                                   .nextStep = "check the unit of the slopes"});
    if (all == 0) return height;
    if (height.rows == 1 || height.cols == 1) return summed(rises);
    if (unevennessOf(rises.weights) <= mostUneven) {
        Multigrid grids({rises.weights.x, rises.weights.y, {}, {}});
        improve(height, residual, grids, options.residualToReach * options.residualToReach * all, options.mostIterations);
    }
    residual.release();
    const auto left = [&] { return cv::norm(residualOf(rises, height)) / std::sqrt(all); };
    const double first = left();
    if (first <= options.residualToAccept) return height;
    if (!(first <= 1)) height = 0;
    improveByTransform(height, rises, options.residualToReach);
    const double still = left(), limit = std::max(largestResidual, options.residualToAccept);
    if (!(still <= limit))
        throw protocols::workFailed(
            {.what = "the heights around the missing slopes were not found: " + std::to_string(still) + " of their pull is left",
             .where = "a map of " + std::to_string(height.cols) + " x " + std::to_string(height.rows) + " pixels",
             .expected = "at most " + protocols::fixed(limit, 4),
             .nextStep = "cut the map to the part that was measured, or fill its gaps first"});
    return height;
}

}  // namespace rendering::signals
