#include "rendering/display_pitch.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "rendering/friction_image.h"

namespace rendering {

namespace {

/// Rows of a source and where they lie: row j of `values` is at first + j * step of the source's rows.
struct Rows {
    cv::Mat values;
    double first = 0, step = 1;
};

/// Means over whole rows where a new pixel holds more than eight: a Gaussian over all of them would take
/// thousands of taps. A quarter of a new pixel at most, so that the filter that follows decides.
Rows averaged(const cv::Mat& source, double ratio)
{
    const int together = std::min(static_cast<int>(std::min(0.25 / ratio, 1e9)), source.rows);
    if (together < 2) return {source, 0, 1};
    const int count = source.rows / together, left = (source.rows - count * together) / 2;
    Rows rows{cv::Mat(count, source.cols, CV_32FC1), left + (together - 1) / 2.0, static_cast<double>(together)};
    for (int i = 0; i < count; ++i) {
        const int start = left + i * together;
        cv::reduce(source.rowRange(start, start + together), rows.values.row(i), 0, cv::REDUCE_AVG, CV_32F);
    }
    return rows;
}

/// Row i at first + i * step, linearly between its neighbours, mirrored outside.
cv::Mat interpolatedRows(const cv::Mat& source, int count, double first, double step)
{
    cv::Mat result(count, source.cols, CV_32FC1);
    for (int i = 0; i < count; ++i) {
        const double place = first + i * step;
        const int low = static_cast<int>(std::floor(place));
        const double share = place - low;
        const int a = cv::borderInterpolate(low, source.rows, cv::BORDER_REFLECT);
        const int b = cv::borderInterpolate(low + 1, source.rows, cv::BORDER_REFLECT);
        cv::addWeighted(source.row(a), 1 - share, source.row(b), share, 0, result.row(i));
    }
    return result;
}

AtDisplayPitch scaledRows(const cv::Mat& source, double ratio, int most)
{
    const double wanted = std::clamp(std::round(source.rows * ratio), 1.0, 1e9);
    const int count = static_cast<int>(std::min(wanted, static_cast<double>(most)));
    const double skipped = std::floor((wanted - count) / 2);
    const Rows rows = averaged(source, ratio);
    // In rows of `rows`: the new pixel's step, and its first pixel that is kept.
    const double step = 1 / (ratio * rows.step);
    const double first = ((source.rows - 1) / 2.0 - ((wanted - 1) / 2 - skipped) / ratio - rows.first) / rows.step;
    const double sigma = 0.5 * step;
    const int reach = static_cast<int>(std::ceil(4 * sigma));
    const int from = std::clamp(static_cast<int>(std::floor(first)) - reach - 2, 0, rows.values.rows - 1);
    const int to = std::clamp(static_cast<int>(std::ceil(first + count * step)) + reach + 2, from + 1, rows.values.rows);
    cv::Mat needed = rows.values.rowRange(from, to);
    if (ratio < 1) {
        cv::Mat smooth;
        cv::sepFilter2D(needed, smooth, CV_32F, cv::Mat::ones(1, 1, CV_32F), cv::getGaussianKernel(2 * reach + 1, sigma, CV_32F),
                        {-1, -1}, 0, cv::BORDER_REFLECT);
        needed = smooth;
    }
    return {interpolatedRows(needed, count, first - from, step), wanted > count};
}

}  // namespace

AtDisplayPitch atDisplayPitch(const cv::Mat& source, double mmPerPixel, bool bothAxes, cv::Size most)
{
    const double ratio = mmPerPixel / displayMmPerPixel;
    AtDisplayPitch result{source, false};
    if (bothAxes) result = scaledRows(source, ratio, most.height);
    const auto across = scaledRows(result.values.t(), ratio, most.width);
    return {across.values.t(), result.cropped || across.cropped};
}

}  // namespace rendering
