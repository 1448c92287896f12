#include "rendering/signals/periodic_transform.h"

#define POCKETFFT_NO_MULTITHREADING
#include <gemmi/third_party/pocketfft_hdronly.h>

#include <complex>
#include <opencv2/core.hpp>

namespace rendering::signals {

namespace {

pocketfft::stride_t bytesBetween(const cv::Mat& image)
{
    return {static_cast<std::ptrdiff_t>(image.step[0]), static_cast<std::ptrdiff_t>(image.elemSize())};
}

pocketfft::shape_t shapeOf(int rows, int columns) { return {static_cast<std::size_t>(rows), static_cast<std::size_t>(columns)}; }

}  // namespace

cv::Mat fourierTransform(const cv::Mat& values)
{
    CV_Assert(!values.empty() && values.type() == CV_32FC1);
    cv::Mat spectrum(values.rows, values.cols / 2 + 1, CV_32FC2);
    pocketfft::r2c(shapeOf(values.rows, values.cols), bytesBetween(values), bytesBetween(spectrum), {0, 1}, pocketfft::FORWARD,
                   values.ptr<float>(), reinterpret_cast<std::complex<float>*>(spectrum.data), 1.0f);
    return spectrum;
}

cv::Mat inverseFourierTransform(const cv::Mat& spectrum, int columns)
{
    CV_Assert(!spectrum.empty() && spectrum.type() == CV_32FC2 && spectrum.cols == columns / 2 + 1);
    cv::Mat values(spectrum.rows, columns, CV_32FC1);
    pocketfft::c2r(shapeOf(spectrum.rows, columns), bytesBetween(spectrum), bytesBetween(values), {0, 1}, pocketfft::BACKWARD,
                   reinterpret_cast<const std::complex<float>*>(spectrum.data), values.ptr<float>(),
                   static_cast<float>(1.0 / (static_cast<double>(spectrum.rows) * columns)));
    return values;
}

}  // namespace rendering::signals
