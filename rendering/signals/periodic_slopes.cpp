#include "rendering/signals/periodic_slopes.h"

#include <cmath>
#include <complex>
#include <numbers>
#include <opencv2/core.hpp>

#include "protocols/files/errors.h"
#include "rendering/signals/periodic_transform.h"

namespace rendering::signals {

namespace {

using Wave = std::complex<float>;

constexpr double twoPi = 2 * std::numbers::pi;
constexpr double highestComparedFrequency = 0.15;  ///< cycles per pixel
/// Standard deviation of the agreement of one wave whose slopes are unrelated complex normal numbers: the root of a third.
constexpr double unrelatedSpread = 0.577;
constexpr double leastObliquity = 0.2;  ///< |kx ky| / k²; 0.5 on the diagonal

Wave* wavesOf(cv::Mat& spectrum, int row) { return reinterpret_cast<Wave*>(spectrum.ptr(row)); }
const Wave* wavesOf(const cv::Mat& spectrum, int row) { return reinterpret_cast<const Wave*>(spectrum.ptr(row)); }

void requirePeriodicSlopes(const Slopes& slopes, const Pitch& pitch)
{
    if (slopes.x.type() != CV_32FC1 || slopes.y.type() != CV_32FC1 || slopes.x.size() != slopes.y.size() || slopes.x.empty())
        throw protocols::badInput({"the two slopes differ in size or are not 32-bit float", "periodic integration",
                                   "two images of one size", "correct the slopes"});
    if (!(pitch.x > 0) || !(pitch.y > 0) || !std::isfinite(pitch.x) || !std::isfinite(pitch.y))
        throw protocols::badInput({"the pitch is not positive", "periodic integration", "mm per pixel above 0", "correct it"});
    if (!cv::checkRange(slopes.x) || !cv::checkRange(slopes.y))
        throw protocols::badInput(
            {"a slope is not finite", "periodic integration", "finite slopes everywhere", "fill missing slopes first"});
}

}  // namespace

cv::Mat integratePeriodic(const Slopes& slopes, const Pitch& pitch)
{
    requirePeriodicSlopes(slopes, pitch);
    cv::Mat alongX = fourierTransform(slopes.x);
    const cv::Mat alongY = fourierTransform(slopes.y);
    const int rows = slopes.x.rows, columns = slopes.x.cols;
    for (int v = 0; v < rows; ++v) {
        const double ky = twoPi * fourierSlopeFrequency(v, rows) / pitch.y;
        Wave* p = wavesOf(alongX, v);
        const Wave* q = wavesOf(alongY, v);
        for (int u = 0; u < alongX.cols; ++u) {
            const double kx = twoPi * fourierSlopeFrequency(u, columns) / pitch.x, k2 = kx * kx + ky * ky;
            p[u] = k2 == 0 ? Wave(0) : Wave(0, -1) * (p[u] * float(kx / k2) + q[u] * float(ky / k2));
        }
    }
    return inverseFourierTransform(alongX, columns);
}

Slopes periodicSlopes(const cv::Mat& height, const Pitch& pitch)
{
    const cv::Mat spectrum = fourierTransform(height);
    const auto slope = [&](bool isAlongX) {
        cv::Mat result = spectrum.clone();
        for (int v = 0; v < height.rows; ++v)
            for (int u = 0; u < result.cols; ++u)
                wavesOf(result, v)[u] *=
                    Wave(0, static_cast<float>(isAlongX ? twoPi * fourierSlopeFrequency(u, height.cols) / pitch.x
                                                        : twoPi * fourierSlopeFrequency(v, height.rows) / pitch.y));
        return inverseFourierTransform(result, height.cols);
    };
    return {slope(true), slope(false)};
}

bool SlopeAgreement::isClear() const { return std::abs(agreement) > std::max(0.03, 4 * standardError); }

SlopeAgreement slopeAgreement(const Slopes& slopes)
{
    requirePeriodicSlopes(slopes, {1, 1});
    const cv::Mat alongX = fourierTransform(slopes.x), alongY = fourierTransform(slopes.y);
    const int rows = slopes.x.rows, columns = slopes.x.cols;
    double weights = 0, sum = 0, squares = 0;
    for (int v = 0; v < rows; ++v) {
        const double ky = fourierFrequency(v, rows);
        for (int u = 1; u < alongX.cols; ++u) {
            const double kx = fourierFrequency(u, columns), k2 = kx * kx + ky * ky;
            if (k2 > highestComparedFrequency * highestComparedFrequency || std::abs(kx * ky) < leastObliquity * k2) continue;
            const std::complex<double> a = std::complex<double>(wavesOf(alongX, v)[u]) * (ky / std::sqrt(k2));
            const std::complex<double> b = std::complex<double>(wavesOf(alongY, v)[u]) * (kx / std::sqrt(k2));
            const double power = std::norm(a) + std::norm(b);
            if (power == 0) continue;
            const double weight = std::sqrt(power), agreement = 2 * (a * std::conj(b)).real() / power;
            weights += weight;
            sum += weight * agreement;
            squares += weight * weight;
        }
    }
    if (weights == 0) return {};
    return {sum / weights, unrelatedSpread * std::sqrt(squares) / weights};
}

}  // namespace rendering::signals
