#include "rendering/signals/cosine_transform.h"

#define POCKETFFT_NO_MULTITHREADING
#include <gemmi/third_party/pocketfft_hdronly.h>

#include <cmath>
#include <opencv2/core.hpp>

namespace rendering::signals {

namespace {

enum Direction { Inverse = 3, Forward = 2 };  // Types of pocketfft's transform.

enum class Axes { Both, AlongRows };

template <class T>
cv::Mat transformedAs(const cv::Mat& values, Direction direction, Axes axes, double factor)
{
    cv::Mat result(values.size(), values.type());
    const pocketfft::shape_t shape{static_cast<std::size_t>(values.rows), static_cast<std::size_t>(values.cols)};
    const auto steps = [](const cv::Mat& image) {
        return pocketfft::stride_t{static_cast<std::ptrdiff_t>(image.step[0]), static_cast<std::ptrdiff_t>(sizeof(T))};
    };
    const double scale = axes == Axes::Both ? 0.5 / std::sqrt(static_cast<double>(values.total()))
                                            : std::sqrt(0.5 / static_cast<double>(values.cols));
    pocketfft::dct(shape, steps(values), steps(result), axes == Axes::Both ? pocketfft::shape_t{0, 1} : pocketfft::shape_t{1},
                   direction, values.ptr<T>(), result.ptr<T>(), static_cast<T>(scale * factor), true, 1);
    return result;
}

cv::Mat transformed(const cv::Mat& values, Direction direction, Axes axes, double factor = 1)
{
    CV_Assert(!values.empty() && (values.type() == CV_32FC1 || values.type() == CV_64FC1));
    return values.depth() == CV_64F ? transformedAs<double>(values, direction, axes, factor)
                                    : transformedAs<float>(values, direction, axes, factor);
}

}  // namespace

cv::Mat cosineTransform(const cv::Mat& values) { return transformed(values, Forward, Axes::Both); }

cv::Mat inverseCosineTransform(const cv::Mat& coefficients) { return transformed(coefficients, Inverse, Axes::Both); }

cv::Mat cosineTransformOfRows(const cv::Mat& values, double factor)
{
    return transformed(values, Forward, Axes::AlongRows, factor);
}

cv::Mat inverseCosineTransformOfRows(const cv::Mat& coefficients) { return transformed(coefficients, Inverse, Axes::AlongRows); }

}  // namespace rendering::signals
