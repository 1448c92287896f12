#include "rendering/composition/display_pitch.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <opencv2/core.hpp>
#include <vector>

#include "rendering/composition/friction_image.h"

namespace rendering {

namespace {

/// Rows of a source with their positions: row j of `values` lies at first + j * step of the source's rows.
struct SourceRows {
    cv::Mat values;
    double first = 0, step = 1;
};

/// Means over whole rows where a new pixel covers more than eight rows, because a filter over all of them would take
/// thousands of taps. The means cover at most a quarter of a new pixel, so that the following filter decides.
SourceRows averaged(const cv::Mat& source, double ratio)
{
    const int together = std::min(static_cast<int>(std::min(0.25 / ratio, 1e9)), source.rows);
    if (together < 2) return {source, 0, 1};
    const int count = source.rows / together, left = (source.rows - count * together) / 2;
    SourceRows rows{cv::Mat(count, source.cols, CV_32FC1), left + (together - 1) / 2.0, static_cast<double>(together)};
    for (int i = 0; i < count; ++i) {
        const int start = left + i * together;
        cv::reduce(source.rowRange(start, start + together), rows.values.row(i), 0, cv::REDUCE_AVG, CV_32F);
    }
    return rows;
}

/// Lanczos window of three lobes: flat up to a third of the new pixels' rate, under 2 % from two thirds on.
double lanczos(double x)
{
    constexpr double lobes = 3;
    if (std::abs(x) >= lobes) return 0;
    const double angle = std::numbers::pi * x;
    return std::abs(x) < 1e-9 ? 1 : lobes * std::sin(angle) * std::sin(angle / lobes) / (angle * angle);
}

/// Filtered rows; row i is centred at first + i * step of the source, which is mirrored at its border.
cv::Mat filteredRows(const cv::Mat& source, int count, double first, double step)
{
    const double width = std::max(step, 1.0);  // Enlargement is limited by the source's own pixels.
    cv::Mat result = cv::Mat::zeros(count, source.cols, CV_32FC1);
    std::vector<double> weights;
    for (int i = 0; i < count; ++i) {
        const double place = first + i * step;
        const int from = static_cast<int>(std::ceil(place - 3 * width)), to = static_cast<int>(std::floor(place + 3 * width));
        weights.clear();
        for (int k = from; k <= to; ++k) weights.push_back(lanczos((k - place) / width));
        const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
        float* target = result.ptr<float>(i);
        for (int k = from; k <= to; ++k) {
            const float* row = source.ptr<float>(cv::borderInterpolate(k, source.rows, cv::BORDER_REFLECT));
            const auto weight = static_cast<float>(weights[static_cast<std::size_t>(k - from)] / sum);
            for (int j = 0; j < source.cols; ++j) target[j] += weight * row[j];
        }
    }
    return result;
}

AtDisplayPitch scaledRows(const cv::Mat& source, double ratio, int most)
{
    const double wanted = std::clamp(std::round(source.rows * ratio), 1.0, 1e9);
    const int count = static_cast<int>(std::min(wanted, static_cast<double>(most)));
    const double skipped = std::floor((wanted - count) / 2);
    const SourceRows rows = averaged(source, ratio);
    // In rows of `rows`: the step of the new pixels, and the first new pixel that is kept.
    const double step = 1 / (ratio * rows.step);
    const double first = ((source.rows - 1) / 2.0 - ((wanted - 1) / 2 - skipped) / ratio - rows.first) / rows.step;
    return {filteredRows(rows.values, count, first, step), wanted > count};
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
