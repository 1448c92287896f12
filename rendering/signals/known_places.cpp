#include "rendering/signals/known_places.h"

#include <opencv2/core.hpp>

namespace rendering::signals {

namespace {

template <class T>
cv::Mat continuedAs(const cv::Mat& values, const cv::Mat& known)
{
    cv::Mat result = values.clone();
    if (values.rows == 1 && values.cols == 1) return result;
    const cv::Size half((values.cols + 1) / 2, (values.rows + 1) / 2);
    cv::Mat coarse(half, values.type()), coarseKnown(half, CV_8UC1);
    cv::parallel_for_(cv::Range(0, half.height), [&](const cv::Range& rows) {
        for (int i = rows.start; i < rows.end; ++i)
            for (int j = 0; j < half.width; ++j) {
                T sum = 0;
                int count = 0;
                for (int a = 2 * i; a < std::min(2 * i + 2, values.rows); ++a)
                    for (int b = 2 * j; b < std::min(2 * j + 2, values.cols); ++b)
                        if (known.at<uchar>(a, b)) {
                            sum += values.at<T>(a, b);
                            ++count;
                        }
                coarse.at<T>(i, j) = count > 0 ? sum / static_cast<T>(count) : 0;
                coarseKnown.at<uchar>(i, j) = count > 0 ? 255 : 0;
            }
    });
    coarse = continuedAs<T>(coarse, coarseKnown);
    cv::parallel_for_(cv::Range(0, values.rows), [&](const cv::Range& rows) {
        for (int i = rows.start; i < rows.end; ++i)
            for (int j = 0; j < values.cols; ++j)
                if (!known.at<uchar>(i, j)) result.at<T>(i, j) = coarse.at<T>(i / 2, j / 2);
    });
    return result;
}

}  // namespace

cv::Mat continued(const cv::Mat& values, const cv::Mat& known)
{
    return values.depth() == CV_64F ? continuedAs<double>(values, known) : continuedAs<float>(values, known);
}

}  // namespace rendering::signals
