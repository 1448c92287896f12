#include "rendering/signals/surface_integration.h"

#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "protocols/errors.h"
#include "rendering/signals/cosine_transform.h"

namespace rendering::signals {

namespace {

std::string sizeText(const cv::Mat& image) { return std::to_string(image.cols) + " x " + std::to_string(image.rows); }

void require(const Slopes& slopes, const Pitch& pitch)
{
    if (slopes.x.empty() || slopes.x.size() != slopes.y.size())
        throw protocols::badInput(
            {.what = "slopes along x (" + sizeText(slopes.x) + ") and y (" + sizeText(slopes.y) + ") do not belong together",
             .where = "",
             .expected = "two images of one size",
             .nextStep = ""});
    if (slopes.x.channels() != 1 || slopes.y.channels() != 1)
        throw protocols::badInput(
            {.what = "slopes have several channels", .where = "", .expected = "one number a pixel", .nextStep = ""});
    if (!(pitch.x > 0 && pitch.y > 0 && std::isfinite(pitch.x) && std::isfinite(pitch.y)))
        throw protocols::badInput(
            {.what = "the pitch of the slopes is not a length", .where = "", .expected = "mm per pixel above 0", .nextStep = ""});
    if (!cv::checkRange(slopes.x) || !cv::checkRange(slopes.y))
        throw protocols::badInput({.what = "slopes hold values that are not finite",
                                   .where = "",
                                   .expected = "a number at every pixel",
                                   .nextStep = ""});
}

/// Slopes between a pixel and its right neighbour; one column fewer than the slopes.
template <class T>
cv::Mat between(const cv::Mat& slopes, SlopeKind kind)
{
    const cv::Mat left = slopes.colRange(0, slopes.cols - 1);
    cv::Mat result;
    if (kind == SlopeKind::Forward)
        left.convertTo(result, cv::DataType<T>::depth);
    else
        cv::addWeighted(left, 0.5, slopes.colRange(1, slopes.cols), 0.5, 0, result, cv::DataType<T>::depth);
    return result;
}

/// Adds one axis' share of the normal equations' right side: what flows in minus what flows out.
template <class T>
void addSources(cv::Mat& sources, const cv::Mat& edges, double pitch)
{
    for (int i = 0; i < edges.rows; ++i) {
        T* row = sources.ptr<T>(i);
        const T* edge = edges.ptr<T>(i);
        for (int j = 0; j < edges.cols; ++j) {
            const T flow = static_cast<T>(edge[j] / pitch);
            row[j] -= flow;
            row[j + 1] += flow;
        }
    }
}

/// Eigenvalues of the second difference with free ends.
std::vector<double> eigenvalues(int length, double pitch)
{
    std::vector<double> values(static_cast<std::size_t>(length));
    for (int k = 0; k < length; ++k) {
        const double s = 2 * std::sin(std::numbers::pi * k / (2.0 * length)) / pitch;
        values[static_cast<std::size_t>(k)] = s * s;
    }
    return values;
}

template <class T>
cv::Mat solved(const Slopes& slopes, const Pitch& pitch, SlopeKind kind)
{
    const cv::Size size = slopes.x.size();
    cv::Mat sources = cv::Mat::zeros(size, cv::DataType<T>::type);
    if (size.width > 1) addSources<T>(sources, between<T>(slopes.x, kind), pitch.x);
    if (size.height > 1) {
        cv::Mat turned = sources.t();
        addSources<T>(turned, between<T>(slopes.y.t(), kind), pitch.y);
        cv::transpose(turned, sources);
    }
    cv::Mat spectrum = cosineTransform(sources);
    const auto alongX = eigenvalues(size.width, pitch.x);
    const auto alongY = eigenvalues(size.height, pitch.y);
    for (int i = 0; i < size.height; ++i) {
        T* row = spectrum.ptr<T>(i);
        for (int j = 0; j < size.width; ++j)
            row[j] = static_cast<T>(row[j] / (alongY[static_cast<std::size_t>(i)] + alongX[static_cast<std::size_t>(j)]));
    }
    spectrum.at<T>(0, 0) = 0;  // the mean, which slopes do not tell
    return inverseCosineTransform(spectrum);
}

cv::Mat asDouble(const cv::Mat& values)
{
    cv::Mat result;
    values.convertTo(result, CV_64F);
    return result;
}

}  // namespace

cv::Mat integrate(const Slopes& slopes, const Pitch& pitch, SlopeKind kind, IntegrationQuality quality)
{
    require(slopes, pitch);
    return quality == IntegrationQuality::Full ? solved<double>(slopes, pitch, kind) : solved<float>(slopes, pitch, kind);
}

double curlResidual(const Slopes& slopes, const Pitch& pitch)
{
    require(slopes, pitch);
    if (slopes.x.rows < 2 || slopes.x.cols < 2) return 0;
    const cv::Mat alongX = between<double>(asDouble(slopes.x), SlopeKind::Point);
    const cv::Mat alongY = between<double>(asDouble(slopes.y).t(), SlopeKind::Point).t();
    const cv::Mat xChange = (alongX.rowRange(1, alongX.rows) - alongX.rowRange(0, alongX.rows - 1)) / pitch.y;
    const cv::Mat yChange = (alongY.colRange(1, alongY.cols) - alongY.colRange(0, alongY.cols - 1)) / pitch.x;
    const double all = std::hypot(cv::norm(xChange), cv::norm(yChange));
    return all > 0 ? cv::norm(xChange, yChange) / all : 0;
}

cv::Mat withoutLowFrequency(const cv::Mat& heightMm, const Pitch& pitch, double cutoffMm)
{
    if (!(cutoffMm > 0))
        throw protocols::badInput({.what = "a high-pass cut-off of " + std::to_string(cutoffMm) + " mm removes nothing",
                                   .where = "",
                                   .expected = "a wavelength above 0",
                                   .nextStep = ""});
    cv::Mat spectrum = cosineTransform(asDouble(heightMm));
    for (int i = 0; i < spectrum.rows; ++i)
        for (int j = 0; j < spectrum.cols; ++j) {
            const double frequency =
                std::hypot(cosineFrequency(i, spectrum.rows, pitch.y), cosineFrequency(j, spectrum.cols, pitch.x));
            spectrum.at<double>(i, j) *= 1 - std::exp2(-std::pow(cutoffMm * frequency, 2));
        }
    cv::Mat result;
    inverseCosineTransform(spectrum).convertTo(result, heightMm.depth());
    return result;
}

}  // namespace rendering::signals
