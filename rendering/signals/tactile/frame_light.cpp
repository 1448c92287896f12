#include "rendering/signals/tactile/frame_light.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "protocols/files/errors.h"
#include "rendering/signals/tactile/upper_median.h"

namespace rendering::signals {

namespace {

constexpr double otherSensorAbove = 0.06;  ///< mean difference of colour, 0 to 1; untouched frames of one sensor differ by 0.01
/// The same of a frame with an object in it. Real presses of a ball differ by 0.025 from their background (at most 0.034),
/// pressed fabrics by 0.003 (at most 0.012), photographs and frames of other sensors by 0.087 and more.
constexpr double foreignFrameAbove = 0.06;
constexpr double swappedAbove = 0.02, swappedFrameAbove = 0.04;  ///< smaller differences do not show an order of channels
constexpr int fitGrid = 96;                                      ///< number of fitted places along the longer side
constexpr int cubicTerms = 10;

double fullScale(const cv::Mat& frame) { return frame.depth() == CV_16U ? 65535 : 255; }

std::string sizeAndType(const cv::Mat& frame)
{
    return std::to_string(frame.cols) + " x " + std::to_string(frame.rows) + ", " + std::to_string(frame.channels()) +
           (frame.channels() == 1 ? " channel" : " channels") + " of " + std::to_string(8 * frame.elemSize1()) + " bits";
}

cv::Vec<double, cubicTerms> cubic(double u, double v)
{
    return {1, u, v, u * u, u * v, v * v, u * u * u, u * u * v, u * v * v, v * v * v};
}

double placeOf(double index, int length) { return length > 1 ? 2 * index / (length - 1) - 1 : 0; }

double meanDifference(const SensorAppearance& a, const SensorAppearance& b, const std::vector<std::size_t>& channelOrder)
{
    const std::size_t channels = channelOrder.size();
    double sum = 0;
    for (std::size_t i = 0; i < a.colours.size(); ++i)
        sum += std::abs(a.colours[i] - b.colours[i / channels * channels + channelOrder[i % channels]]);
    return sum / static_cast<double>(a.colours.size());
}

}  // namespace

cv::Mat logIllumination(const cv::Mat& channel)
{
    const int step = std::max(1, std::max(channel.rows, channel.cols) / fitGrid);
    std::vector<cv::Vec<double, cubicTerms>> terms;
    std::vector<double> levels;
    cv::Mat values;
    channel.convertTo(values, CV_32F);
    for (int i = step / 2; i < values.rows; i += step)
        for (int j = step / 2; j < values.cols; j += step) {
            terms.push_back(cubic(placeOf(j, values.cols), placeOf(i, values.rows)));
            levels.push_back(std::log(std::max(1.F, values.at<float>(i, j))));
        }
    cv::Vec<double, cubicTerms> surface;
    std::vector<double> weights(levels.size(), 1);
    for (int round = 0; round < 15; ++round) {
        cv::Matx<double, cubicTerms, cubicTerms> normal = 1e-9 * cv::Matx<double, cubicTerms, cubicTerms>::eye();
        cv::Vec<double, cubicTerms> right;
        for (std::size_t s = 0; s < levels.size(); ++s) {
            normal += weights[s] * (terms[s] * terms[s].t());
            right += weights[s] * levels[s] * terms[s];
        }
        cv::solve(normal, right, surface, cv::DECOMP_CHOLESKY);
        std::vector<double> deviations(levels.size());
        for (std::size_t s = 0; s < levels.size(); ++s) deviations[s] = std::abs(levels[s] - terms[s].dot(surface));
        const double spread = std::max(1e-6, 2 * 1.4826 * upperMedian(deviations));
        for (std::size_t s = 0; s < levels.size(); ++s) weights[s] = 1 / (1 + deviations[s] * deviations[s] / (spread * spread));
    }
    cv::Mat result(channel.size(), CV_32FC1);
    for (int i = 0; i < result.rows; ++i)
        for (int j = 0; j < result.cols; ++j)
            result.at<float>(i, j) = static_cast<float>(surface.dot(cubic(placeOf(j, result.cols), placeOf(i, result.rows))));
    return result;
}

cv::Mat lightOf(const cv::Mat& frame, const cv::Mat& reference, LightMeasure measure)
{
    const bool readable = !frame.empty() && (frame.depth() == CV_8U || frame.depth() == CV_16U);
    if (!readable ||
        (measure == LightMeasure::AgainstReference && (frame.type() != reference.type() || frame.size() != reference.size())))
        throw protocols::badInput({.what = "the tactile frame (" + sizeAndType(frame) + ") does not match its reference (" +
                                           sizeAndType(reference) + ")",
                                   .where = "",
                                   .expected = "images of 8 or 16 bits with one size and type",
                                   .nextStep = "use the reference frame of the same sensor"});
    cv::Mat light;
    if (measure == LightMeasure::AgainstReference) {
        cv::subtract(frame, reference, light, cv::noArray(), CV_32F);
        light *= 1 / fullScale(frame);
        return light;
    }
    std::vector<cv::Mat> channels;
    cv::split(frame, channels);
    for (auto& channel : channels) {
        cv::Mat illumination, level;
        cv::exp(logIllumination(channel), illumination);
        channel.convertTo(level, CV_32F);
        channel = level / illumination - 1;
    }
    cv::merge(channels, light);
    return light;
}

cv::Mat oneFrame(const std::vector<cv::Mat>& lamps)
{
    for (const auto& lamp : lamps)
        if (lamp.empty() || lamp.channels() != 1 || lamp.size() != lamps.front().size() || lamp.depth() != lamps.front().depth())
            throw protocols::badInput(
                {.what = "the frames of the lamps differ (" + sizeAndType(lamps.front()) + "; " + sizeAndType(lamp) + ")",
                 .where = "",
                 .expected = "grey images of one size, one for each lamp",
                 .nextStep = "export all frames at one size"});
    cv::Mat frame;
    cv::merge(lamps, frame);
    return frame;
}

SensorAppearance appearanceOf(const cv::Mat& reference)
{
    cv::Mat coarse;
    reference.convertTo(coarse, CV_32F, 1 / fullScale(reference));
    cv::resize(coarse, coarse, {SensorAppearance::columns, SensorAppearance::rows}, 0, 0, cv::INTER_AREA);
    const cv::Mat flat = coarse.reshape(1, 1);
    return {reference.cols, reference.rows, std::vector<double>(flat.begin<float>(), flat.end<float>())};
}

namespace {

std::optional<std::string> differenceAbove(const SensorAppearance& known, const SensorAppearance& found, double swapAbove,
                                           double otherAbove)
{
    if (known.width != found.width || known.height != found.height)
        return "it has " + std::to_string(found.width) + " x " + std::to_string(found.height) + " pixels, but the sensor has " +
               std::to_string(known.width) + " x " + std::to_string(known.height);
    if (known.colours.size() != found.colours.size()) return "its number of channels differs";
    std::vector<std::size_t> order(known.colours.size() / (SensorAppearance::columns * SensorAppearance::rows));
    std::iota(order.begin(), order.end(), 0);
    const double asItIs = meanDifference(known, found, order);
    if (order.size() == 3) {
        const double swapped = meanDifference(known, found, {2, 1, 0});
        if (asItIs > swapAbove && swapped < 0.5 * asItIs) return "its red and blue are swapped";
    }
    if (asItIs > otherAbove)
        return "its colours differ by " + std::to_string(std::lround(100 * asItIs)) +
               " % of full scale, so it shows another sensor or other light";
    return std::nullopt;
}

}  // namespace

std::optional<std::string> differenceOf(const SensorAppearance& known, const SensorAppearance& found)
{
    return differenceAbove(known, found, swappedAbove, otherSensorAbove);
}

std::optional<std::string> foreignLight(const cv::Mat& background, const cv::Mat& frame)
{
    return differenceAbove(appearanceOf(background), appearanceOf(frame), swappedFrameAbove, foreignFrameAbove);
}

}  // namespace rendering::signals
