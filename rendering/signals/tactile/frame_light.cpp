#include "rendering/signals/tactile/frame_light.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "protocols/files/errors.h"
#include "rendering/signals/tactile/upper_median.h"

namespace rendering::signals {

namespace {

/// Of a frame with an object in it. Real presses of a ball differ by 0.025 from their background (at most 0.034), pressed fabrics
/// by 0.003 (at most 0.012), photographs and frames of other sensors by 0.087 and more.
constexpr AppearanceLimits framesInUse{0.04, 0.06};
constexpr int fitGrid = 96;  ///< number of fitted places along the longer side
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

std::optional<std::string> foreignLight(const cv::Mat& background, const cv::Mat& frame)
{
    return differenceOf(appearanceOf(background), appearanceOf(frame), framesInUse);
}

}  // namespace rendering::signals
