#include "rendering/signals/tactile/surface_calibration.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "protocols/files/errors.h"
#include "rendering/signals/tactile/photometric_stereo.h"

namespace rendering::signals {

namespace {

constexpr std::size_t samplesWanted = 60000;
constexpr double mostSlope = 10;        ///< mm/mm; heights in micrometres give slopes of hundreds
constexpr double ownLightScale = 2;     ///< light differs from its own illumination by up to about a half
constexpr double ownLightRidge = 1e-4;  ///< the channels are correlated, and the map is used on other rows than those of the fit

/// Central differences over the pitch, one-sided at the borders; NaN beside unknown heights.
Slopes slopesOfHeight(const cv::Mat& heightMm, const Pitch& pitch)
{
    Slopes slopes{cv::Mat(heightMm.size(), CV_32FC1), cv::Mat(heightMm.size(), CV_32FC1)};
    cv::Mat height;
    heightMm.convertTo(height, CV_64F);
    const auto rise = [&](int i0, int j0, int i1, int j1, double step) {
        const int count = std::max(1, (i1 - i0) + (j1 - j0));
        return static_cast<float>((height.at<double>(i1, j1) - height.at<double>(i0, j0)) / (count * step));
    };
    for (int i = 0; i < height.rows; ++i)
        for (int j = 0; j < height.cols; ++j) {
            slopes.x.at<float>(i, j) = rise(i, std::max(0, j - 1), i, std::min(height.cols - 1, j + 1), pitch.x);
            slopes.y.at<float>(i, j) = rise(std::max(0, i - 1), j, std::min(height.rows - 1, i + 1), j, pitch.y);
        }
    return slopes;
}

LightMeasure measureOf(const KnownSurfaceFrame& surface)
{
    return surface.reference.empty() ? LightMeasure::AgainstOwnLight : LightMeasure::AgainstReference;
}

void requireFitting(const KnownSurfaceFrame& surface, int first, int last)
{
    const auto fault = [](const std::string& what, const std::string& expected) {
        return protocols::badInput(
            {.what = what, .where = "", .expected = expected, .nextStep = "check that frame and surface belong together"});
    };
    if (surface.heightMm.type() != CV_32FC1 && surface.heightMm.type() != CV_64FC1)
        throw fault("the surface has " + std::to_string(surface.heightMm.channels()) + " channels of " +
                        std::to_string(8 * surface.heightMm.elemSize1()) + " bits",
                    "one channel of floating-point numbers, mm");
    if (surface.frame.size() != surface.heightMm.size())
        throw fault("the frame has " + std::to_string(surface.frame.cols) + " x " + std::to_string(surface.frame.rows) +
                        " pixels, but the surface has " + std::to_string(surface.heightMm.cols) + " x " +
                        std::to_string(surface.heightMm.rows),
                    "a height for each pixel");
    if (!(surface.pitch.x > 0 && std::abs(surface.pitch.x / surface.pitch.y - 1) < 0.01))
        throw fault("the pitch of the surface differs along x and y", "square pixels, like those of the frame");
    if (first < 0 || last > surface.heightMm.rows || first >= last)
        throw fault("rows " + std::to_string(first) + " to " + std::to_string(last) + " do not lie in the surface",
                    "rows from 0 to " + std::to_string(surface.heightMm.rows));
}

/// The given rows where the slope is known.
cv::Mat knownPlaces(const Slopes& slopes, int first, int last)
{
    cv::Mat places = cv::Mat::zeros(slopes.x.size(), CV_8UC1);
    measuredPlaces({slopes.x.rowRange(first, last), slopes.y.rowRange(first, last)}).copyTo(places.rowRange(first, last));
    return places;
}

void requireMillimetres(const Slopes& known, const cv::Mat& places)
{
    const cv::Mat steep = ((cv::abs(known.x) > mostSlope) | (cv::abs(known.y) > mostSlope)) & places;
    if (2 * cv::countNonZero(steep) <= cv::countNonZero(places)) return;
    throw protocols::badInput(
        {.what = "more than half of the surface is steeper than 10 mm per mm, as heights in other units are",
         .where = "",
         .expected = "heights and pitch in mm",
         .nextStep = "convert the heights to mm, or correct the pitch"});
}

cv::Mat withoutQuadratic(const cv::Mat& values, const cv::Mat& places)
{
    cv::Matx<double, 6, 6> normal;
    cv::Vec<double, 6> right, surface;
    const auto terms = [&](int i, int j) {
        const double u = 2.0 * j / values.cols - 1, v = 2.0 * i / values.rows - 1;
        return cv::Vec<double, 6>(1, u, v, u * u, u * v, v * v);
    };
    for (int i = 0; i < values.rows; ++i)
        for (int j = 0; j < values.cols; ++j)
            if (places.at<uchar>(i, j)) {
                normal += terms(i, j) * terms(i, j).t();
                right += values.at<double>(i, j) * terms(i, j);
            }
    cv::solve(normal, right, surface, cv::DECOMP_SVD);
    cv::Mat result = cv::Mat::zeros(values.size(), CV_64FC1);
    for (int i = 0; i < values.rows; ++i)
        for (int j = 0; j < values.cols; ++j)
            if (places.at<uchar>(i, j)) result.at<double>(i, j) = values.at<double>(i, j) - surface.dot(terms(i, j));
    return result;
}

}  // namespace

Calibration calibrationFrom(const KnownSurfaceFrame& surface, int first, int last, MapQuality quality)
{
    requireFitting(surface, first, last);
    const Slopes known = slopesOfHeight(surface.heightMm, surface.pitch);
    const cv::Mat places = knownPlaces(known, first, last);
    requireMillimetres(known, places);
    SlopeSamples samples;
    samples.channels = surface.frame.channels();
    const auto count = static_cast<std::size_t>(cv::countNonZero(places));
    samples.add(lightOf(surface.frame, surface.reference, measureOf(surface)), known, places,
                static_cast<int>(std::max<std::size_t>(1, count / samplesWanted)));
    FitOptions options;
    options.quality = quality;
    if (surface.reference.empty()) {  // The illumination is already removed, and other rows may be evaluated.
        options.byPlace = false;
        options.lightScale = ownLightScale;
        options.ridge = ownLightRidge;
    }
    Calibration calibration;
    calibration.light = measureOf(surface);
    calibration.channels = samples.channels;
    calibration.map = fitSlopeMap(samples, options);
    calibration.mmPerPixel = surface.pitch.x;
    if (!surface.reference.empty()) calibration.sensor = appearanceOf(surface.reference);
    return calibration;
}

SurfaceScore scoreOf(const Calibration& calibration, const KnownSurfaceFrame& surface, int first, int last)
{
    requireFitting(surface, first, last);
    const Slopes all = slopesFromFrame(surface.frame, surface.reference, calibration);
    const Slopes slopes{all.x.rowRange(first, last).clone(), all.y.rowRange(first, last).clone()};
    const Slopes known = slopesOfHeight(surface.heightMm, surface.pitch);
    const cv::Mat places = knownPlaces(known, first, last).rowRange(first, last);
    SurfaceScore score;
    const auto meanError = [&](const cv::Mat& found, const cv::Mat& truth) {
        return cv::mean(cv::abs(found - truth.rowRange(first, last)), places)[0];
    };
    score.slopeError = (meanError(slopes.x, known.x) + meanError(slopes.y, known.y)) / 2;
    cv::Mat truth;
    surface.heightMm.rowRange(first, last).convertTo(truth, CV_64F);
    truth.setTo(0, places == 0);
    const cv::Mat error = withoutQuadratic(integrate(slopes, surface.pitch) - truth, places);
    score.heightErrorMm = cv::norm(error) / std::sqrt(std::max(1, cv::countNonZero(places)));
    cv::Scalar mean, sd;
    cv::meanStdDev(truth, mean, sd, places);
    score.knownSqMm = sd[0];
    return score;
}

}  // namespace rendering::signals
