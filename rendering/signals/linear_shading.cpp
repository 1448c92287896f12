#include "rendering/signals/linear_shading.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "protocols/files/errors.h"
#include "rendering/signals/periodic_transform.h"

namespace rendering::signals {

namespace {

constexpr int shadingWindowStepPx = 32, mostShadingWindows = 8;  ///< windows along a side
constexpr int borderPx = 32;                                     ///< mirrored, so that the transform's borders do not meet
/// Spatial frequencies from one wave per window to one per two pixels, evenly spaced in the logarithm.
constexpr int ringCount = 14;
constexpr double ringWidth = 1;                 ///< standard deviation of the weight of a frequency for a ring, rings
constexpr double farthestRing = 2.5;            ///< farther ones have no weight, standard deviations
constexpr int directionBins = 6;                ///< of the squared cosine
constexpr double chanceShareOfOneWindow = 0.5;  ///< found with noise of several spectra in pictures of 64 to 1,024 px
constexpr int fitRounds = 4;                    ///< of the fit, whose weights follow the fitted powers
constexpr double shareOfOtherRings = 0.3;  ///< the share of a ring is drawn towards the mean share, which many more waves tell

/// A frequency of a transform, relative to the lamp.
struct LampWave {
    double length = 0;     ///< cycles per pixel
    double alongLamp = 0;  ///< its part along the lamp, signed
    double cosine2() const { return length > 0 ? alongLamp * alongLamp / (length * length) : 0; }
    /// Place among the rings, 0 to ringCount - 1.
    double ring() const
    {
        const double lowest = std::log(1.0 / shadingWindowPx), highest = std::log(0.5);
        const double place = (std::log(std::max(length, 1e-9)) - lowest) / (highest - lowest);
        return std::clamp(place, 0.0, 1.0) * (ringCount - 1);
    }
};

/// Frequencies of the transform of a picture under one lamp.
class LampWaves {
public:
    LampWaves(cv::Size picture, double lightDeg)
        : m_size(picture),
          m_right(std::cos(lightDeg * std::numbers::pi / 180)),
          m_down(-std::sin(lightDeg * std::numbers::pi / 180))
    {
    }
    LampWave at(int row, int column) const
    {
        const double right = fourierFrequency(column, m_size.width), down = fourierFrequency(row, m_size.height);
        return {std::hypot(right, down), right * m_right + down * m_down};
    }

private:
    cv::Size m_size;
    double m_right, m_down;
};

/// Powers of dye and of shading at one spatial frequency: dye + shading * cos^2 of the angle to the lamp.
struct RingPower {
    double dye = 0, shading = 0;
    double mean() const { return dye + shading / 2; }
    double share() const { return mean() > 0 ? shading / 2 / mean() : 0; }
};

struct DirectionPower {
    double power = 0, cosine2 = 0, weight = 0;
};

std::vector<int> windowCorners(int length)
{
    const int room = length - shadingWindowPx;
    const int count = std::clamp(room / shadingWindowStepPx + 1, 1, mostShadingWindows);
    std::vector<int> corners;
    for (int i = 0; i < count; ++i) corners.push_back(count == 1 ? room / 2 : room * i / (count - 1));
    return corners;
}

/// Power summed over windows (Welch), CV_32FC1 [window x (window / 2 + 1)].
cv::Mat windowPowers(const cv::Mat& contrast)
{
    cv::Mat line(1, shadingWindowPx, CV_32F);
    for (int i = 0; i < shadingWindowPx; ++i)
        line.at<float>(i) = static_cast<float>(0.5 - 0.5 * std::cos(2 * std::numbers::pi * i / shadingWindowPx));
    const cv::Mat hann = line.t() * line;
    cv::Mat sum = cv::Mat::zeros(shadingWindowPx, shadingWindowPx / 2 + 1, CV_32F);
    for (const int y : windowCorners(contrast.rows))
        for (const int x : windowCorners(contrast.cols)) {
            const cv::Mat part = contrast({x, y, shadingWindowPx, shadingWindowPx});
            cv::Mat planes[2];
            cv::split(fourierTransform((part - cv::mean(part)[0]).mul(hann)), planes);
            sum += planes[0].mul(planes[0]) + planes[1].mul(planes[1]);
        }
    return sum;
}

struct WeightedPower {
    double power = 0, weight = 0;
};

double medianPower(std::vector<WeightedPower>& powers)
{
    std::sort(powers.begin(), powers.end(), [](const auto& a, const auto& b) { return a.power < b.power; });
    double half = 0;
    for (const WeightedPower& one : powers) half += one.weight / 2;
    for (const WeightedPower& one : powers)
        if ((half -= one.weight) <= 0) return one.power;
    return powers.back().power;
}

/// A frequency of the windows, with its power.
struct WindowWave {
    double ring = 0, cosine2 = 0, power = 0;
    double copies = 2;  ///< in the whole plane; the half plane that the transform leaves out mirrors the other
};

std::vector<WindowWave> windowWaves(const cv::Mat& contrast, double lightDeg)
{
    const cv::Mat powers = windowPowers(contrast);
    const LampWaves waves({shadingWindowPx, shadingWindowPx}, lightDeg);
    std::vector<WindowWave> all;
    for (int row = 0; row < powers.rows; ++row)
        for (int column = 0; column < powers.cols; ++column) {
            const LampWave wave = waves.at(row, column);
            if (!(wave.length > 0 && wave.length <= 0.5)) continue;
            all.push_back({wave.ring(), wave.cosine2(), powers.at<float>(row, column),
                           column == 0 || column == powers.cols - 1 ? 1.0 : 2.0});
        }
    return all;
}

/// Powers by direction, of the frequencies near a ring.
std::vector<DirectionPower> directionPowers(const std::vector<WindowWave>& waves, int ring)
{
    std::array<std::vector<WeightedPower>, directionBins> bins;
    std::array<double, directionBins> cosines{};
    for (const WindowWave& wave : waves) {
        const double distance = (wave.ring - ring) / ringWidth;
        if (std::abs(distance) > farthestRing) continue;
        const double weight = wave.copies * std::exp(-distance * distance / 2);
        const auto bin = static_cast<std::size_t>(std::min(wave.cosine2 * directionBins, directionBins - 1.0));
        bins[bin].push_back({wave.power, weight});
        cosines[bin] += weight * wave.cosine2;
    }
    std::vector<DirectionPower> all;
    for (std::size_t i = 0; i < bins.size(); ++i) {
        double weight = 0;
        for (const WeightedPower& one : bins[i]) weight += one.weight;
        if (weight > 0) all.push_back({medianPower(bins[i]), cosines[i] / weight, weight});
    }
    return all;
}

/// Weighted sum of squares that a fit leaves.
double squaresLeft(const std::vector<DirectionPower>& points, const std::vector<double>& weights, const RingPower& fit)
{
    double sum = 0;
    for (std::size_t i = 0; i < points.size(); ++i)
        sum += weights[i] * std::pow(points[i].power - fit.dye - fit.shading * points[i].cosine2, 2);
    return sum;
}

/// Least squares with dye and shading of at least 0.
RingPower fittedPower(const std::vector<DirectionPower>& points, const std::vector<double>& weights)
{
    double w = 0, x = 0, y = 0, xx = 0, xy = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const DirectionPower& one = points[i];
        w += weights[i];
        x += weights[i] * one.cosine2;
        y += weights[i] * one.power;
        xx += weights[i] * one.cosine2 * one.cosine2;
        xy += weights[i] * one.cosine2 * one.power;
    }
    const double determinant = w * xx - x * x;
    if (determinant > 0) {
        const RingPower free{(xx * y - x * xy) / determinant, (w * xy - x * y) / determinant};
        if (free.dye >= 0 && free.shading >= 0) return free;
    }
    const RingPower onlyDye{y / w, 0}, onlyShading{0, xx > 0 ? xy / xx : 0};
    return squaresLeft(points, weights, onlyDye) <= squaresLeft(points, weights, onlyShading) ? onlyDye : onlyShading;
}

RingPower ringPower(const std::vector<DirectionPower>& points)
{
    double total = 0, weight = 0;
    for (const DirectionPower& one : points) {
        total += one.weight * one.power;
        weight += one.weight;
    }
    if (!(total > 0)) return {};
    RingPower fit{total / weight, 0};
    for (int round = 0; round < fitRounds; ++round) {  // The spread of a power is proportional to the power.
        std::vector<double> weights;
        for (const DirectionPower& one : points) {
            const double expected = fit.dye + fit.shading * one.cosine2 + 1e-6 * total / weight;
            weights.push_back(one.weight / (expected * expected));
        }
        fit = fittedPower(points, weights);
    }
    return fit;
}

using RingPowers = std::array<RingPower, ringCount>;

RingPower between(const RingPowers& rings, double place)
{
    const auto low = static_cast<std::size_t>(place), high = std::min(low + 1, rings.size() - 1);
    const double share = place - static_cast<double>(low);
    return {(1 - share) * rings[low].dye + share * rings[high].dye,
            (1 - share) * rings[low].shading + share * rings[high].shading};
}

/// Multiplies a transform of contrast with the Wiener filter, which makes it one of relief.
void invertShading(cv::Mat& transform, cv::Size picture, double lightDeg, const RingPowers& rings)
{
    constexpr double leastFrequency = 1e-9;
    const LampWaves waves(picture, lightDeg);
    for (int row = 0; row < transform.rows; ++row)
        for (int column = 0; column < transform.cols; ++column) {
            auto& value = transform.at<cv::Vec2f>(row, column);
            const LampWave wave = waves.at(row, column);
            const RingPower power = between(rings, wave.ring());
            const double shading = power.shading * wave.cosine2(), all = power.dye + shading;
            if (!(all > 0) || std::abs(wave.alongLamp) < leastFrequency) {
                value = {0, 0};
                continue;
            }
            // Brightness is -2 pi i f times height, where f is the frequency along the lamp.
            const auto gain = static_cast<float>(shading / all / (2 * std::numbers::pi * wave.alongLamp));
            value = {-gain * value[1], gain * value[0]};
        }
}

}  // namespace

LinearShading linearShading(const cv::Mat& contrast, double lightDeg)
{
    CV_Assert(contrast.type() == CV_32FC1);
    if (std::min(contrast.rows, contrast.cols) < shadingWindowPx)
        throw protocols::badInput({"a picture of " + std::to_string(contrast.cols) + " x " + std::to_string(contrast.rows) +
                                       " px is too small for its shading to be judged",
                                   "photograph", "sides of at least " + std::to_string(shadingWindowPx) + " px",
                                   "use a larger photograph"});
    const std::vector<WindowWave> waves = windowWaves(contrast, lightDeg);
    RingPowers rings;
    LinearShading result;
    const auto windows = windowCorners(contrast.rows).size() * windowCorners(contrast.cols).size();
    result.chanceShare = chanceShareOfOneWindow / std::sqrt(static_cast<double>(windows));
    for (int ring = 0; ring < ringCount; ++ring) {
        RingPower& power = rings[static_cast<std::size_t>(ring)] = ringPower(directionPowers(waves, ring));
        result.shadingShare += power.share() / ringCount;
    }
    for (RingPower& power : rings) {
        const double share = (1 - shareOfOtherRings) * power.share() + shareOfOtherRings * result.shadingShare;
        power = {power.mean() * (1 - share), 2 * power.mean() * share};
    }
    cv::Mat wide;
    cv::copyMakeBorder(contrast, wide, borderPx, borderPx, borderPx, borderPx, cv::BORDER_REFLECT_101 | cv::BORDER_ISOLATED);
    cv::Mat transform = fourierTransform(wide);
    invertShading(transform, wide.size(), lightDeg, rings);
    result.relief = inverseFourierTransform(transform, wide.cols)({borderPx, borderPx, contrast.cols, contrast.rows}).clone();
    return result;
}

}  // namespace rendering::signals
