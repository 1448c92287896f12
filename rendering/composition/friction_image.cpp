#include "rendering/composition/friction_image.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "protocols/files/errors.h"
#include "rendering/composition/display_pitch.h"

namespace rendering {

namespace {

/// Squares of larger values exceed the range of 32-bit numbers.
constexpr double largestValue = 1e30;

void requireValues(const cv::Mat& values, const protocols::Condition& condition)
{
    if (values.empty() || !cv::checkRange(values, true, nullptr, -largestValue, largestValue))
        throw protocols::workFailed({.what = "the signal of " + std::string(condition.id) +
                                             (values.empty() ? " is empty" : " holds values that are not finite or exceed 1e30"),
                                     .where = "",
                                     .expected = "a finite number at every place",
                                     .nextStep = "check the data set with vis2hap fabrics check"});
}

double requirePitch(double mmPerPixel, const protocols::Condition& condition)
{
    if (!(mmPerPixel > 0 && std::isfinite(mmPerPixel)))
        throw protocols::badInput({.what = "the physical scale of " + std::string(condition.id) + " is unknown",
                                   .where = "",
                                   .expected = "mm_per_pixel in dataset.json",
                                   .nextStep = "state it in dataset.json, or use --scale pixels"});
    return mmPerPixel;
}

/// Sum of squares about `mean`, times the area of a pixel.
double power(const cv::Mat& values, double mean, double pixelArea)
{
    cv::Scalar own, sd;
    cv::meanStdDev(values, own, sd);
    return (sd[0] * sd[0] + (own[0] - mean) * (own[0] - mean)) * static_cast<double>(values.total()) * pixelArea;
}

/// `shown`: the part of the source that reaches the screen, without repetitions.
std::optional<double> varianceLost(const cv::Mat& source, double sourcePitch, const cv::Mat& shown, double shownPitch)
{
    if (shown.data == source.data && shown.size() == source.size()) {
        double least = 0, most = 0;
        cv::minMaxLoc(source, &least, &most);
        return most > least ? std::optional(0.0) : std::nullopt;
    }
    const double ratio = shownPitch / sourcePitch, area = source.rows == 1 && shown.rows == 1 ? ratio : ratio * ratio;
    const double mean = cv::mean(source)[0], all = power(source, mean, 1);
    if (!(all > 0)) return {};
    return std::clamp(1 - power(shown, mean, area) / all, 0.0, 1.0);
}

ScaledMap onScreen(const cv::Mat& source, double mmPerPixel, DisplayScale scale, Extension extension)
{
    const cv::Size screen(displayWidthPx, displayHeightPx);
    AtDisplayPitch shown{source, false};
    if (scale == DisplayScale::Physical) {
        shown = atDisplayPitch(source, mmPerPixel, source.rows > 1, screen);
    } else if (source.cols > screen.width || source.rows > screen.height) {
        const cv::Size kept(std::min(source.cols, screen.width), std::min(source.rows, screen.height));
        shown = {source(cv::Rect((source.cols - kept.width) / 2, (source.rows - kept.height) / 2, kept.width, kept.height)),
                 true};
    }
    auto extended = extendToScreen(shown.values, extension);
    if (shown.cropped && extended.how == "none") extended.how = "none (cropped)";
    const double pitch = scale == DisplayScale::Physical ? displayMmPerPixel : mmPerPixel;
    return {extended.values, extended.how, varianceLost(source, mmPerPixel, shown.values, pitch), extended.agreement};
}

ScaledMap composeTrace(const protocols::Condition& condition, const Sources& sources, DisplayScale scale, Extension extension)
{
    cv::Mat line;
    cv::Mat(1, static_cast<int>(sources.trace.size()), CV_64FC1, const_cast<double*>(sources.trace.data()))
        .convertTo(line, CV_32F);
    requireValues(line, condition);
    const double pitch = scale == DisplayScale::Physical ? requirePitch(sources.traceMmPerSample, condition) : 1;
    return onScreen(line, pitch, scale, extension);
}

}  // namespace

ScaledMap compose(const protocols::Condition& condition, const Sources& sources, DisplayScale scale, Extension extension)
{
    if (condition.relief == protocols::ReliefSource::None) return composeTrace(condition, sources, scale, extension);
    requireValues(sources.relief, condition);
    cv::Mat relief = sources.relief;
    if (relief.type() != CV_32FC1) sources.relief.convertTo(relief, CV_32F);
    const double pitch = scale == DisplayScale::Physical ? requirePitch(sources.reliefMmPerPixel.value_or(0), condition) : 1;
    ScaledMap map = onScreen(relief, pitch, scale, extension);
    if (sources.reliefLeftOut) {
        map.varianceLost = sources.reliefLeftOut;
        if (map.extension == "none") map.extension = "none (cropped)";
    }
    if (condition.friction == protocols::FrictionSource::None) return map;
    if (!sources.meanFriction || !std::isfinite(*sources.meanFriction))
        throw protocols::workFailed({.what = "the mean friction of " + std::string(condition.id) + " is missing",
                                     .where = "",
                                     .expected = "a finite number",
                                     .nextStep = "check the data set with vis2hap fabrics check"});
    if (*sources.meanFriction < 0)
        throw protocols::badInput(
            {.what = "the mean friction of " + std::string(condition.id) + " is negative, so its relief would be upside down",
             .where = "",
             .expected = "a mean of at least 0",
             .nextStep = "negate the friction record"});
    // On the screen values exceed the source only by the overshoot of a filter.
    requireValues(cv::Mat(1, 1, CV_64FC1, cv::Scalar(cv::norm(relief, cv::NORM_INF) * *sources.meanFriction)), condition);
    map.values *= *sources.meanFriction;
    return map;
}

}  // namespace rendering
