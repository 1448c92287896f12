#include "rendering/signals/height_gradient.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "protocols/files/errors.h"

namespace rendering::signals {

namespace {

void requireValid(const cv::Mat& heightMm, double mmPerPixel, const GradientOptions& options)
{
    if (heightMm.empty() || heightMm.channels() != 1 || !cv::checkRange(heightMm))
        throw protocols::badInput({.what = "the height map is empty or holds values that are not finite",
                                   .where = "",
                                   .expected = "a finite height at every pixel",
                                   .nextStep = "fill the gaps of the height map"});
    if (!(mmPerPixel > 0 && std::isfinite(mmPerPixel)) ||
        !(options.leastSlope > 0 && options.mostSlope > options.leastSlope && std::isfinite(options.mostSlope)))
        throw protocols::badInput({.what = "the gradient needs a pitch and bounds of the slope",
                                   .where = "",
                                   .expected = "mm per pixel above 0, 0 < least slope < most slope",
                                   .nextStep = "state tactile.mm_per_pixel in dataset.json"});
}

}  // namespace

cv::Mat heightGradient(const cv::Mat& heightMm, double mmPerPixel, const GradientOptions& options)
{
    requireValid(heightMm, mmPerPixel, options);
    cv::Mat height;
    heightMm.convertTo(height, CV_64F);  // Differences of large 32-bit heights would only hold rounding.
    cv::Mat result(height.size(), CV_32FC1);
    const double least = options.leastSlope * options.leastSlope, most = options.mostSlope * options.mostSlope;
    const int rows = height.rows, columns = height.cols;
    for (int i = 0; i < rows; ++i) {
        const int above = std::max(i - 1, 0), below = std::min(i + 1, rows - 1);
        const double perRow = above == below ? 0 : 1 / ((below - above) * mmPerPixel);
        const double *up = height.ptr<double>(above), *down = height.ptr<double>(below), *row = height.ptr<double>(i);
        for (int j = 0; j < columns; ++j) {
            const int left = std::max(j - 1, 0), right = std::min(j + 1, columns - 1);
            const double perColumn = left == right ? 0 : 1 / ((right - left) * mmPerPixel);
            const double x = (row[right] - row[left]) * perColumn, y = (down[j] - up[j]) * perRow;
            result.at<float>(i, j) = static_cast<float>(std::log10(std::clamp(x * x + y * y, least, most)));
        }
    }
    return result;
}

}  // namespace rendering::signals
