#include "rendering/models/cloth/cloth_features.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace rendering::models {

namespace {

constexpr int largestPx = 1536, smallestPx = 48, mostParts = 6, leastPartPx = 24, bandCount = 4;
constexpr float darkestLevel = 2;       ///< black has no logarithm
constexpr double leastContrast = 3e-3;  ///< of the logarithm: below the noise of any camera
constexpr float noGradient = 1e-3F;

using Values = std::vector<double>;

cv::Mat ofUsualSize(const cv::Mat& rgb)
{
    const int longer = std::max(rgb.cols, rgb.rows), shorter = std::min(rgb.cols, rgb.rows);
    const double factor = std::min(1.0, double(largestPx) / longer);
    cv::Mat result = rgb;
    if (shorter * factor < smallestPx) {  // A narrow strip would lose its last row: it is widened instead.
        const auto side = [&](int length) { return std::max(smallestPx, cvRound(length * factor)); };
        cv::resize(rgb, result, {side(rgb.cols), side(rgb.rows)}, 0, 0, cv::INTER_LINEAR);
    } else if (factor < 1) {
        cv::resize(rgb, result, {}, factor, factor, cv::INTER_AREA);
    }
    return result;
}

/// Logarithms of red, green and blue, and of brightness.
struct Logarithms {
    std::array<cv::Mat, 3> colours;
    cv::Mat brightness;
};

Logarithms logarithmsOf(const cv::Mat& rgb)
{
    cv::Mat levels;
    cv::max(rgb, cv::Scalar::all(darkestLevel), levels);
    levels.convertTo(levels, CV_32F, 1.0 / 255);
    cv::log(levels, levels);
    Logarithms result;
    cv::split(levels, result.colours.data());
    result.brightness = 0.30 * result.colours[0] + 0.59 * result.colours[1] + 0.11 * result.colours[2];
    return result;
}

/// Contrast of about 1, 2, 4 and 8 px.
std::array<cv::Mat, bandCount> bandsOf(const cv::Mat& brightness)
{
    std::array<cv::Mat, bandCount> bands;
    cv::Mat rest = brightness;
    for (int k = 0; k < bandCount; ++k) {
        cv::Mat smooth;
        cv::GaussianBlur(rest, smooth, {}, k == 0 ? 1.0 : 0.87 * (1 << k));
        bands[std::size_t(k)] = rest - smooth;
        rest = smooth;
    }
    return bands;
}

/// Standard deviation of what a curved surface over the picture (a plane, where there are few parts) does not explain. Uneven
/// light is such a surface.
double unevenness(const Values& values, int across)
{
    const int terms = across >= 4 ? 6 : 3, count = int(values.size());
    cv::Mat surface(count, terms, CV_64F), wanted(count, 1, CV_64F), weights;
    for (int i = 0; i < count; ++i) {
        const double y = double(i / across) / (across - 1) - 0.5, x = double(i % across) / (across - 1) - 0.5;
        const double all[] = {1, x, y, x * x, y * y, x * y};
        for (int k = 0; k < terms; ++k) surface.at<double>(i, k) = all[k];
        wanted.at<double>(i) = values[std::size_t(i)];
    }
    cv::solve(surface, wanted, weights, cv::DECOMP_SVD);
    return cv::norm(wanted - surface * weights) / std::sqrt(std::max(1, count - terms));
}

double deviation(const Values& values)
{
    cv::Scalar mean, spread;
    cv::meanStdDev(values, mean, spread);
    return spread[0];
}

double quantile(Values values, double share)
{
    std::sort(values.begin(), values.end());
    const double place = share * double(values.size() - 1);
    const auto below = std::size_t(place);
    const double above = values[std::min(below + 1, values.size() - 1)];
    return values[below] + (place - double(below)) * (above - values[below]);
}

Values difference(const Values& a, const Values& b)
{
    Values result(a);
    for (std::size_t i = 0; i < a.size(); ++i) result[i] -= b[i];
    return result;
}

/// What each part of the picture holds, row by row.
struct Parts {
    std::array<Values, bandCount> contrasts;  ///< logarithms
    std::array<Values, 3> colours;
    Values sparseness, along, across;  ///< kurtosis; direction of the gradients as cosine and sine of the double angle
};

double kurtosis(const cv::Mat& part)
{
    cv::Scalar mean, spread;
    cv::meanStdDev(part, mean, spread);
    const double variance = spread[0] * spread[0];
    if (variance < 1e-6) return 0;
    cv::Mat squared = part - mean[0];
    squared = squared.mul(squared);
    return cv::mean(squared.mul(squared))[0] / (variance * variance + 1e-8);
}

Parts partsOf(const Logarithms& logarithms, const cv::Mat& slopeX, const cv::Mat& slopeY, int count)
{
    const auto bands = bandsOf(logarithms.brightness);
    const cv::Size size = logarithms.brightness.size();
    Parts parts;
    for (int row = 0; row < count; ++row)
        for (int column = 0; column < count; ++column) {
            const cv::Rect part(cv::Point(column * size.width / count, row * size.height / count),
                                cv::Point((column + 1) * size.width / count, (row + 1) * size.height / count));
            for (std::size_t k = 0; k < bandCount; ++k) {
                cv::Scalar mean, spread;
                cv::meanStdDev(bands[k](part), mean, spread);
                parts.contrasts[k].push_back(std::log(spread[0] + leastContrast));
            }
            for (std::size_t c = 0; c < 3; ++c) parts.colours[c].push_back(cv::mean(logarithms.colours[c](part))[0]);
            parts.sparseness.push_back(kurtosis(bands[1](part)));
            const cv::Mat x = slopeX(part), y = slopeY(part);
            const double xx = x.dot(x), yy = y.dot(y), all = xx + yy + 1e-6 * double(part.area());
            parts.along.push_back((xx - yy) / all);
            parts.across.push_back(2 * x.dot(y) / all);
        }
    return parts;
}

}  // namespace

ClothFeatures clothFeatures(const cv::Mat& rgb)
{
    const cv::Mat picture = ofUsualSize(rgb);
    const Logarithms logarithms = logarithmsOf(picture);
    cv::Mat slopeX, slopeY;
    cv::Sobel(logarithms.brightness, slopeX, CV_32F, 1, 0);
    cv::Sobel(logarithms.brightness, slopeY, CV_32F, 0, 1);
    const int count = std::clamp(std::min(picture.cols, picture.rows) / leastPartPx, 2, mostParts);
    const Parts parts = partsOf(logarithms, slopeX, slopeY, count);
    ClothFeatures features{};
    std::size_t next = 0;
    const auto add = [&](double value) { features[next++] = value; };
    for (const Values& contrast : parts.contrasts) add(unevenness(contrast, count));
    for (const Values& contrast : parts.contrasts) add(deviation(contrast));
    for (const Values& contrast : parts.contrasts) add(quantile(contrast, 0.5));
    for (std::size_t k = 0; k < 3; ++k) add(quantile(parts.contrasts[k], 0));
    Values brightness = parts.colours[0];
    for (std::size_t i = 0; i < brightness.size(); ++i)
        brightness[i] = (parts.colours[0][i] + parts.colours[1][i] + parts.colours[2][i]) / 3;
    add(unevenness(brightness, count));
    add(unevenness(difference(parts.colours[0], parts.colours[1]), count));
    add(unevenness(difference(parts.colours[2], parts.colours[1]), count));
    add(std::log(quantile(parts.sparseness, 0.5) + 1));
    add(std::log(quantile(parts.sparseness, 0.9) + 1));
    add(std::hypot(unevenness(parts.along, count), unevenness(parts.across, count)));
    const cv::Mat gradient = cv::abs(slopeX) + cv::abs(slopeY);
    add(double(cv::countNonZero(gradient < noGradient)) / double(gradient.total()));
    return features;
}

}  // namespace rendering::models
