#include "rendering/signals/repeated_place.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "rendering/signals/periodic_transform.h"

namespace rendering::signals {

namespace {

constexpr int windowPx = 33, nearestCopyPx = 24, mostSidePx = 1400, peakPx = 7;
constexpr double longestWavePx = 8;  ///< sigma of the Gaussian that is subtracted
constexpr double leastMatch = 0.95;  ///< neighbouring threads of one weave match at up to 0.95
constexpr double leastPeak = 8;      ///< standard deviations of the cepstrum
constexpr std::size_t mostCandidates = 24;

cv::Mat shifted(const cv::Mat& picture, cv::Point by)
{
    cv::Mat wide;
    cv::copyMakeBorder(picture, wide, 0, by.y, 0, by.x, cv::BORDER_WRAP | cv::BORDER_ISOLATED);
    return wide(cv::Rect(by.x, by.y, picture.cols, picture.rows));
}

cv::Mat wrapped(const cv::Mat& picture, int margin)
{
    cv::Mat wide;
    cv::copyMakeBorder(picture, wide, margin, margin, margin, margin, cv::BORDER_WRAP | cv::BORDER_ISOLATED);
    return wide;
}

/// Borders are mirrored, so that a tile whose borders do not meet has no edge there.
cv::Mat withoutLongWaves(const cv::Mat& picture)
{
    cv::Mat smooth;
    cv::GaussianBlur(picture, smooth, {}, longestWavePx, longestWavePx, cv::BORDER_REFLECT | cv::BORDER_ISOLATED);
    return picture - smooth;
}

cv::Mat windowMeans(const cv::Mat& picture)
{
    cv::Mat means;
    cv::blur(wrapped(picture, windowPx / 2), means, {windowPx, windowPx});
    return means(cv::Rect(windowPx / 2, windowPx / 2, picture.cols, picture.rows));
}

/// The power cepstrum: a copy at a distance adds a ripple to the logarithm of the spectrum, and so a peak here.
cv::Mat cepstrum(const cv::Mat& picture)
{
    cv::Mat spectrum = fourierTransform(picture);
    for (int v = 0; v < spectrum.rows; ++v) {
        auto* waves = reinterpret_cast<std::complex<float>*>(spectrum.ptr(v));
        for (int u = 0; u < spectrum.cols; ++u) waves[u] = std::log(std::norm(waves[u]) + 1e-12f);
    }
    return inverseFourierTransform(spectrum, picture.cols);
}

std::vector<cv::Point> candidatesIn(const cv::Mat& cepstra)
{
    struct Peak {
        float value;
        cv::Point at;
    };
    std::vector<Peak> peaks;
    cv::Scalar mean, spread;
    cv::Mat inner = cepstra.clone();
    const auto isNear = [&](int k, int length) { return std::min(k, length - k) < nearestCopyPx; };
    for (int y = 0; y < inner.rows; ++y)
        for (int x = 0; x < inner.cols; ++x)
            if (isNear(y, inner.rows) && isNear(x, inner.cols)) inner.at<float>(y, x) = 0;
    cv::meanStdDev(inner, mean, spread);
    cv::Mat around;  // A smooth spectrum raises whole neighbourhoods: only their highest points are candidates.
    cv::dilate(inner, around, cv::Mat::ones(peakPx, peakPx, CV_8UC1));
    for (int y = 0; y <= inner.rows / 2; ++y)  // The other half repeats this one.
        for (int x = 0; x < inner.cols; ++x) {
            const float value = inner.at<float>(y, x);
            if (value > leastPeak * spread[0] && value == around.at<float>(y, x)) peaks.push_back({value, {x, y}});
        }
    const auto count = std::min(mostCandidates, peaks.size());
    std::partial_sort(peaks.begin(), peaks.begin() + static_cast<std::ptrdiff_t>(count), peaks.end(),
                      [](const Peak& a, const Peak& b) { return a.value > b.value; });
    std::vector<cv::Point> places;
    for (std::size_t i = 0; i < count; ++i) places.push_back(peaks[i].at);
    return places;
}

}  // namespace

std::optional<RepeatedPlace> repeatedPlace(const cv::Mat& picture, double leastShare)
{
    const int factor = (std::max(picture.rows, picture.cols) + mostSidePx - 1) / mostSidePx;
    cv::Mat small = picture;
    if (factor > 1) cv::resize(picture, small, {picture.cols / factor, picture.rows / factor}, 0, 0, cv::INTER_AREA);
    if (std::min(small.rows, small.cols) <= 2 * nearestCopyPx) return {};
    const cv::Mat texture = withoutLongWaves(small);
    const cv::Mat power = windowMeans(texture.mul(texture));
    const double floor = 1e-6 * cv::mean(power)[0];
    if (!(floor > 0)) return {};
    std::optional<RepeatedPlace> best;
    for (const cv::Point& place : candidatesIn(cepstrum(texture))) {
        cv::Mat scale;
        cv::sqrt(power.mul(shifted(power, place)) + floor * floor, scale);
        const cv::Mat match = windowMeans(texture.mul(shifted(texture, place))) / scale;
        const double share = double(cv::countNonZero(match >= leastMatch)) / double(match.total());
        double largest = 0;
        cv::minMaxLoc(match, nullptr, &largest);
        if (share >= leastShare && (!best || share > best->share))
            best = RepeatedPlace{largest, share, place.x * factor, place.y * factor};
    }
    return best;
}

}  // namespace rendering::signals
