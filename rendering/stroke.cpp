#include "rendering/stroke.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace rendering {

namespace {

/// Pixel values as the finger pad feels them along the row: the image averaged over the contact.
std::vector<double> feltAlong(const cv::Mat& image, int row, double sigmaPx)
{
    const int reach = std::max(1, static_cast<int>(std::ceil(3 * sigmaPx)));
    const cv::Mat kernel = cv::getGaussianKernel(2 * reach + 1, std::max(sigmaPx, 1e-3), CV_64F);
    cv::Mat line = cv::Mat::zeros(1, image.cols, CV_64FC1);
    for (int offset = -reach; offset <= reach; ++offset) {
        cv::Mat neighbour;
        image.row(std::clamp(row + offset, 0, image.rows - 1)).convertTo(neighbour, CV_64F);
        line += kernel.at<double>(offset + reach) * neighbour;
    }
    cv::Mat felt;
    cv::sepFilter2D(line, felt, CV_64F, kernel, cv::Mat::ones(1, 1, CV_64F), {-1, -1}, 0, cv::BORDER_REPLICATE);
    return {felt.begin<double>(), felt.end<double>()};
}

double at(const std::vector<double>& values, double place)
{
    const auto low = static_cast<std::size_t>(place);
    const auto high = std::min(low + 1, values.size() - 1);
    return values[low] + (place - static_cast<double>(low)) * (values[high] - values[low]);
}

}  // namespace

std::vector<double> strokeForce(const cv::Mat& image, int row, bool vertical, const StrokeOptions& options)
{
    assert(image.type() == CV_8UC1 && "friction images have one byte a pixel");
    assert(options.speedMmPerS > 0 && options.sampleRateHz > 0 && options.mmPerPixel > 0);
    const cv::Mat upright = vertical ? cv::Mat(image.t()) : image;
    assert(row >= 0 && row < upright.rows && "the stroke runs over the image");
    const auto felt = feltAlong(upright, row, options.contactMm / 2 / options.mmPerPixel);

    const double pixelsPerSample = options.speedMmPerS / options.sampleRateHz / options.mmPerPixel;
    const auto count = static_cast<std::size_t>(std::floor((static_cast<double>(felt.size()) - 1) / pixelsPerSample + 1e-9)) + 1;
    const double frictionPerLevel = (options.highestFriction - options.glassFriction) / 255;
    // Exact for a force that is constant over a sample; without delay for a time constant of 0.
    const double keep = options.responseS > 0 ? std::exp(-1 / (options.responseS * options.sampleRateHz)) : 0;

    std::vector<double> force(count);
    for (std::size_t i = 0; i < count; ++i) {
        const double place = std::min(static_cast<double>(i) * pixelsPerSample, static_cast<double>(felt.size() - 1));
        const double driven = options.normalForceN * (options.glassFriction + frictionPerLevel * at(felt, place));
        force[i] = i == 0 ? driven : keep * force[i - 1] + (1 - keep) * driven;
    }
    return force;
}

}  // namespace rendering
