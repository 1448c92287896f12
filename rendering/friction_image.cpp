#include "rendering/friction_image.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "protocols/errors.h"

namespace rendering {

namespace {

/// Row i of `source` at position i * step + offset, linearly between its neighbours, mirrored outside.
cv::Mat resampledRows(const cv::Mat& source, int count, double offset, double step)
{
    cv::Mat result(count, source.cols, CV_32FC1);
    for (int i = 0; i < count; ++i) {
        const double place = offset + i * step;
        const int low = static_cast<int>(std::floor(place));
        const double share = place - low;
        const int a = cv::borderInterpolate(low, source.rows, cv::BORDER_REFLECT);
        const int b = cv::borderInterpolate(low + 1, source.rows, cv::BORDER_REFLECT);
        cv::addWeighted(source.row(a), 1 - share, source.row(b), share, 0, result.row(i));
    }
    return result;
}

/// To `ratio` times the pixels along the rows, centre on centre. Made smaller, the source first passes a
/// Gaussian of half a new pixel, which leaves under 1 % of what the new pixels cannot hold.
cv::Mat scaledRows(const cv::Mat& source, double ratio)
{
    const int count = std::max(1, static_cast<int>(std::lround(source.rows * ratio)));
    cv::Mat smooth = source;
    if (ratio < 1) {
        const double sigma = 0.5 / ratio;
        const int reach = static_cast<int>(std::ceil(4 * sigma));
        cv::sepFilter2D(source, smooth, CV_32F, cv::Mat::ones(1, 1, CV_32F), cv::getGaussianKernel(2 * reach + 1, sigma, CV_32F),
                        {-1, -1}, 0, cv::BORDER_REFLECT);
    }
    const double centre = (source.rows - 1) / 2.0;
    return resampledRows(smooth, count, centre - (count - 1) / 2.0 / ratio, 1 / ratio);
}

cv::Mat toDisplayPitch(const cv::Mat& source, double mmPerPixel, bool bothAxes)
{
    const double ratio = mmPerPixel / displayMmPerPixel;
    cv::Mat result = bothAxes ? scaledRows(source, ratio) : source;
    result = scaledRows(result.t(), ratio).t();
    return result;
}

/// Centred on the screen: cropped where it is larger, continued by its mirror image where smaller.
ScaledMap onScreen(const cv::Mat& source)
{
    const cv::Size screen(displayWidthPx, displayHeightPx);
    const cv::Size kept(std::min(source.cols, screen.width), std::min(source.rows, screen.height));
    const cv::Mat inside =
        source(cv::Rect((source.cols - kept.width) / 2, (source.rows - kept.height) / 2, kept.width, kept.height));
    const int left = (screen.width - kept.width) / 2, top = (screen.height - kept.height) / 2;
    ScaledMap map;
    cv::copyMakeBorder(inside, map.values, top, screen.height - kept.height - top, left, screen.width - kept.width - left,
                       cv::BORDER_REFLECT);
    if (kept != screen)
        map.extension = "mirror";
    else
        map.extension = inside.size() == source.size() ? "none" : "none (cropped)";
    return map;
}

void requireFinite(const cv::Mat& values, const protocols::Condition& condition)
{
    if (values.empty() || !cv::checkRange(values))
        throw protocols::workFailed({.what = "the signal of " + std::string(condition.id) +
                                             (values.empty() ? " is empty" : " holds values that are not finite"),
                                     .where = "",
                                     .expected = "a number at every place",
                                     .nextStep = "check the data set with vis2hap fabrics check"});
}

double requirePitch(double mmPerPixel, const protocols::Condition& condition)
{
    if (!(mmPerPixel > 0 && std::isfinite(mmPerPixel)))
        throw protocols::badInput({.what = "the physical scale of " + std::string(condition.id) + " is unknown",
                                   .where = "",
                                   .expected = "mm_per_pixel in dataset.json",
                                   .nextStep = "state it there, or use --scale pixels"});
    return mmPerPixel;
}

ScaledMap composeTrace(const protocols::Condition& condition, const Sources& sources, Scale scale)
{
    cv::Mat line;
    cv::Mat(1, static_cast<int>(sources.trace.size()), CV_64FC1, const_cast<double*>(sources.trace.data()))
        .convertTo(line, CV_32F);
    requireFinite(line, condition);
    if (scale == Scale::Physical) line = toDisplayPitch(line, requirePitch(sources.traceMmPerSample, condition), false);
    return onScreen(line);
}

}  // namespace

ScaledMap compose(const protocols::Condition& condition, const Sources& sources, Scale scale)
{
    if (condition.relief == protocols::ReliefSource::None) return composeTrace(condition, sources, scale);
    requireFinite(sources.relief, condition);
    cv::Mat relief;
    sources.relief.convertTo(relief, CV_32F);
    if (scale == Scale::Physical)
        relief = toDisplayPitch(relief, requirePitch(sources.reliefMmPerPixel.value_or(0), condition), true);
    ScaledMap map = onScreen(relief);
    if (condition.friction == protocols::FrictionSource::None) return map;
    if (!sources.meanFriction || !std::isfinite(*sources.meanFriction))
        throw protocols::workFailed({.what = "the mean friction of " + std::string(condition.id) + " is missing",
                                     .where = "",
                                     .expected = "a number",
                                     .nextStep = "check the data set with vis2hap fabrics check"});
    map.values *= *sources.meanFriction;
    return map;
}

void MapRange::include(const ScaledMap& map)
{
    double low = 0, high = 0;
    cv::minMaxLoc(map.values, &low, &high);
    min = empty ? low : std::min(min, low);
    max = empty ? high : std::max(max, high);
    empty = false;
}

cv::Mat mapToDisplay(const ScaledMap& map, const MapRange& range)
{
    if (range.constant()) return cv::Mat::zeros(map.values.size(), CV_8UC1);
    cv::Mat centred, image;
    // Subtracted before scaling: a narrow range far from 0 would lose its last digits otherwise.
    cv::subtract(map.values, cv::Scalar(range.min), centred, cv::noArray(), CV_64F);
    centred.convertTo(image, CV_8U, 255 / (range.max - range.min));
    return image;
}

}  // namespace rendering
