#include "rendering/signals/cosine_transform.h"

#define POCKETFFT_NO_MULTITHREADING
#include <gemmi/third_party/pocketfft_hdronly.h>

#include <cmath>
#include <opencv2/core.hpp>

namespace rendering::signals {

namespace {

enum Direction { Inverse = 3, Forward = 2 };  // Types of pocketfft's transform.

template <class T>
cv::Mat transformedAs(const cv::Mat& values, Direction direction)
{
    cv::Mat result(values.size(), values.type());
    const pocketfft::shape_t shape{static_cast<std::size_t>(values.rows), static_cast<std::size_t>(values.cols)};
    const auto steps = [](const cv::Mat& image) {
        return pocketfft::stride_t{static_cast<std::ptrdiff_t>(image.step[0]), static_cast<std::ptrdiff_t>(sizeof(T))};
    };
    pocketfft::dct(shape, steps(values), steps(result), {0, 1}, direction, values.ptr<T>(), result.ptr<T>(),
                   static_cast<T>(0.5 / std::sqrt(static_cast<double>(values.total()))), true, 1);
    return result;
}

cv::Mat transformed(const cv::Mat& values, Direction direction)
{
    CV_Assert(!values.empty() && (values.type() == CV_32FC1 || values.type() == CV_64FC1));
    return values.depth() == CV_64F ? transformedAs<double>(values, direction) : transformedAs<float>(values, direction);
}

}  // namespace

cv::Mat cosineTransform(const cv::Mat& values) { return transformed(values, Forward); }

cv::Mat inverseCosineTransform(const cv::Mat& coefficients) { return transformed(coefficients, Inverse); }

}  // namespace rendering::signals
