#include "rendering/signals/mirrored_columns.h"

#include <cmath>
#include <cstddef>
#include <opencv2/core.hpp>

#include "stats/kernels/vector_clones.h"

namespace rendering::signals {

namespace {

constexpr double negligible = 1e-18;  ///< weight of a value that cannot change a sum of 64 bits

/// The smaller root r of r + 1/r = 2 + stiffness.
double rootFor(double stiffness)
{
    const double half = stiffness / 2;
    return 1 / (1 + half + std::sqrt(half * (2 + half)));
}

// The sums run in 64 bits; what is stored between the two recursions has the depth of the image.
template <class T>
[[gnu::always_inline]] inline void downwards(T* __restrict row, double* __restrict sum, const double* __restrict root,
                                             std::size_t n)
{
    for (std::size_t j = 0; j < n; ++j) {
        sum[j] = row[j] + root[j] * sum[j];
        row[j] = static_cast<T>(sum[j]);
    }
}

template <class T>
[[gnu::always_inline]] inline void upwards(T* __restrict row, double* __restrict sum, const double* __restrict root,
                                           std::size_t n)
{
    for (std::size_t j = 0; j < n; ++j) {
        sum[j] = root[j] * (row[j] + sum[j]);
        row[j] = static_cast<T>(sum[j]);
    }
}

STATS_VECTOR_CLONES void down(float* row, double* sum, const double* root, std::size_t n) { downwards(row, sum, root, n); }
STATS_VECTOR_CLONES void down(double* row, double* sum, const double* root, std::size_t n) { downwards(row, sum, root, n); }
STATS_VECTOR_CLONES void up(float* row, double* sum, const double* root, std::size_t n) { upwards(row, sum, root, n); }
STATS_VECTOR_CLONES void up(double* row, double* sum, const double* root, std::size_t n) { upwards(row, sum, root, n); }

/// What the recursion downwards brings from the rows above the image, which mirror it again and again.
template <class T>
std::vector<double> sumsAbove(const cv::Mat& values, const std::vector<double>& root)
{
    std::vector<double> nearest(root.size(), 0), farthest(root.size(), 0), weight(root.size(), 1);
    const int rows = values.rows;
    std::size_t reaching = root.size();  // Roots descend, so the columns that still count come first.
    for (int i = 0; i < rows && reaching > 0; ++i) {
        const T* first = values.ptr<T>(i);
        const T* last = values.ptr<T>(rows - 1 - i);
        for (std::size_t j = 0; j < reaching; ++j) {
            nearest[j] += weight[j] * first[j];
            farthest[j] += weight[j] * last[j];
            weight[j] *= root[j];
        }
        while (reaching > 0 && weight[reaching - 1] < negligible) weight[--reaching] = 0;
    }
    for (std::size_t j = 0; j < root.size(); ++j)  // weight is root^rows now
        nearest[j] = (nearest[j] + weight[j] * farthest[j]) / (1 - weight[j] * weight[j]);
    return nearest;
}

/// A column without stiffness: two sums, and the mean taken away.
template <class T>
void integrateTwice(cv::Mat column)
{
    const int rows = column.rows;
    double mean = 0, rise = 0, height = 0, total = 0;
    for (int i = 0; i < rows; ++i) mean += column.at<T>(i);
    mean /= rows;
    std::vector<double> heights;
    for (int i = 0; i < rows; ++i) {
        heights.push_back(height);
        total += height;
        rise -= column.at<T>(i) - mean;
        height += rise;
    }
    for (int i = 0; i < rows; ++i) column.at<T>(i) = static_cast<T>(heights[static_cast<std::size_t>(i)] - total / rows);
}

template <class T>
void solve(cv::Mat& values, const std::vector<double>& stiffness)
{
    std::size_t free = 0;
    while (free < stiffness.size() && !(stiffness[free] > 0)) integrateTwice<T>(values.col(static_cast<int>(free++)));
    if (free == stiffness.size()) return;
    cv::Mat rest = values.colRange(static_cast<int>(free), values.cols);
    std::vector<double> root;
    for (std::size_t j = free; j < stiffness.size(); ++j) root.push_back(rootFor(stiffness[j]));
    std::vector<double> sum = sumsAbove<T>(rest, root);
    for (int i = 0; i < rest.rows; ++i) down(rest.ptr<T>(i), sum.data(), root.data(), root.size());
    for (std::size_t j = 0; j < root.size(); ++j) sum[j] *= root[j] / (1 - root[j]);  // the row below the last one repeats it
    for (int i = rest.rows - 1; i >= 0; --i) up(rest.ptr<T>(i), sum.data(), root.data(), root.size());
}

}  // namespace

void solveMirroredColumns(cv::Mat& values, const std::vector<double>& stiffness)
{
    CV_Assert(values.type() == CV_32FC1 || values.type() == CV_64FC1);
    CV_Assert(stiffness.size() == static_cast<std::size_t>(values.cols));
    values.depth() == CV_64F ? solve<double>(values, stiffness) : solve<float>(values, stiffness);
}

}  // namespace rendering::signals
