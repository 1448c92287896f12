#include "rendering/models/ring_spectrum.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <numbers>
#include <opencv2/core.hpp>
#include <optional>

#include "rendering/signals/tactile/photometric_stereo.h"

namespace rendering::models {

namespace {

/// The ring below a frequency, and the share of the ring above it.
struct RingPair {
    int lower = -1;   ///< -1 outside all rings
    float share = 0;  ///< weight of the ring above
};

/// Rings of a window's frequencies. Only one quarter is stored, because the others mirror it.
struct Rings {
    int width = 0;
    std::vector<RingPair> pairs;  ///< [(width / 2 + 1) x (width / 2 + 1)], row-major; cycles per window down and to the right
    cv::Mat window;               ///< Hann window
    double sum = 0, energy = 0;   ///< sum of the window, and of its square

    const RingPair& at(int row, int column) const
    {
        return pairs[static_cast<std::size_t>(std::min(row, width - row) * (width / 2 + 1) + std::min(column, width - column))];
    }
};

cv::Mat hannWindow(int side)
{
    cv::Mat line(1, side, CV_32F);
    for (int i = 0; i < side; ++i) line.at<float>(i) = static_cast<float>(0.5 - 0.5 * std::cos(2 * std::numbers::pi * i / side));
    return line.t() * line;
}

RingPair ringPair(double frequency, int side)
{
    // A period as long as the window is barely detectable; a longer one is not.
    if (frequency * side < 0.9 || frequency > 0.5) return {};
    const double place = ringPlace(frequency, side);
    const int lower = std::min(static_cast<int>(place), ringCount - 2);
    return {lower, static_cast<float>(place - lower)};
}

Rings makeRings(int width, int side)
{
    Rings rings{width, {}, hannWindow(width)};
    rings.sum = cv::sum(rings.window)[0];
    rings.energy = rings.window.dot(rings.window);
    for (int row = 0; row <= width / 2; ++row)
        for (int column = 0; column <= width / 2; ++column)
            rings.pairs.push_back(ringPair(std::hypot(row, column) / width, side));
    return rings;
}

/// Tables for one size, made at the first call.
const Rings& ringsOf(int width, int side)
{
    static std::mutex guard;
    static std::map<std::pair<int, int>, Rings> made;
    const std::lock_guard<std::mutex> lock(guard);
    const auto found = made.find({width, side});
    return found != made.end() ? found->second : made.emplace(std::pair(width, side), makeRings(width, side)).first->second;
}

void addPowers(const cv::Mat& part, const Rings& rings, cv::Mat& sums)
{
    const double mean = part.dot(rings.window) / rings.sum;
    cv::Mat centred = (part - mean).mul(rings.window), transform, planes[2];
    cv::dft(centred, transform, cv::DFT_COMPLEX_OUTPUT);
    cv::split(transform, planes);
    sums += planes[0].mul(planes[0]) + planes[1].mul(planes[1]);
}

/// Corners of windows that overlap by half; the last window ends at the border.
std::vector<int> cornersAlong(int length, int width)
{
    std::vector<int> corners;
    for (int at = 0; at + width < length; at += width / 2) corners.push_back(at);
    corners.push_back(length - width);
    return corners;
}

/// A multiple of eight, so that transforms are fast and few tables are kept.
int widthOfWindows(const cv::Size& size, int side)
{
    return std::max(side, std::min({size.width, size.height, 2 * side}) / 8 * 8);
}

cv::Mat atLeastAWindow(const cv::Mat& map, int side)
{
    if (map.rows >= side && map.cols >= side) return map;
    cv::Mat wide;
    cv::copyMakeBorder(map, wide, 0, std::max(0, side - map.rows), 0, std::max(0, side - map.cols), cv::BORDER_REFLECT);
    return wide;
}

/// Mean power of each ring. An empty ring takes the value of its lower neighbour; empty rings at the long end take the first
/// value.
std::vector<double> averaged(const cv::Mat& powers, const Rings& rings)
{
    std::vector<double> total(ringCount), weight(ringCount);
    for (int row = 0; row < powers.rows; ++row)
        for (int column = 0; column < powers.cols; ++column) {
            const RingPair& pair = rings.at(row, column);
            if (pair.lower < 0) continue;
            const auto lower = static_cast<std::size_t>(pair.lower);
            const double power = static_cast<double>(powers.at<float>(row, column)), share = static_cast<double>(pair.share);
            total[lower] += (1 - share) * power;
            weight[lower] += 1 - share;
            total[lower + 1] += share * power;
            weight[lower + 1] += share;
        }
    for (std::size_t i = 0; i < total.size(); ++i) total[i] = weight[i] > 0 ? total[i] / weight[i] : total[i > 0 ? i - 1 : 0];
    const auto first = std::find_if(weight.begin(), weight.end(), [](double sum) { return sum > 0; }) - weight.begin();
    std::fill_n(total.begin(), first, total[static_cast<std::size_t>(std::min<std::ptrdiff_t>(first, ringCount - 1))]);
    return total;
}

constexpr int gainsPerCycle = 4096;

/// Gains by frequency, in steps of 1 / gainsPerCycle cycles per pixel up to the corner of the transform; interpolated
/// between the rings.
std::vector<float> gainTable(const std::vector<double>& logGain, int side)
{
    std::vector<float> gains;
    for (int i = 0; i <= static_cast<int>(0.72 * gainsPerCycle); ++i) {
        const double frequency = (i + 0.5) / gainsPerCycle, place = ringPlace(frequency, side);
        const auto ring = std::min(static_cast<std::size_t>(place), logGain.size() - 2);
        const double share = place - static_cast<double>(ring);
        const double fourth = std::pow(frequency * side, 4);
        gains.push_back(
            static_cast<float>(fourth / (1 + fourth) * std::exp((1 - share) * logGain[ring] + share * logGain[ring + 1])));
    }
    return gains;
}

/// Transform of a map, from which every pass of a filter starts.
class Spectrum {
public:
    /// `heightMm` without its mean, mirrored by at most `mostBorder` px on each side.
    Spectrum(const cv::Mat& heightMm, int mostBorder)
        : m_inner(std::min(mostBorder, heightMm.cols - 1), std::min(mostBorder, heightMm.rows - 1), heightMm.cols, heightMm.rows)
    {
        const auto beyond = [](int length, int border) { return cv::getOptimalDFTSize(length + 2 * border) - length - border; };
        cv::Mat padded;
        cv::copyMakeBorder(heightMm - cv::mean(heightMm)[0], padded, m_inner.y, beyond(m_inner.height, m_inner.y), m_inner.x,
                           beyond(m_inner.width, m_inner.x), cv::BORDER_REFLECT_101);
        cv::dft(padded, m_transform, cv::DFT_COMPLEX_OUTPUT);
    }

    cv::Mat times(const std::vector<float>& gains) const
    {
        cv::Mat changed(m_transform.size(), m_transform.type()), result;
        const int rows = changed.rows, columns = changed.cols;
        for (int row = 0; row < rows; ++row) {
            const float down = static_cast<float>(std::min(row, rows - row)) / static_cast<float>(rows) * gainsPerCycle;
            const cv::Vec2f* from = m_transform.ptr<cv::Vec2f>(row);
            cv::Vec2f* to = changed.ptr<cv::Vec2f>(row);
            for (int column = 0; column < columns; ++column) {
                const float right =
                    static_cast<float>(std::min(column, columns - column)) / static_cast<float>(columns) * gainsPerCycle;
                to[column] = from[column] * gains[static_cast<std::size_t>(std::sqrt(down * down + right * right))];
            }
        }
        cv::dft(changed, result, cv::DFT_INVERSE | cv::DFT_REAL_OUTPUT | cv::DFT_SCALE);
        return result(m_inner).clone();
    }

private:
    cv::Rect m_inner;
    cv::Mat m_transform;
};

}  // namespace

double ringPlace(double frequency, int side)
{
    // The scale changes from linear to logarithmic at an eighth of the highest frequency.
    const double highest = side / 2.0, bend = side / 16.0;
    const double cycles = std::clamp(frequency * side, 1.0, highest);
    return (ringCount - 1) * std::log((cycles + bend) / (1 + bend)) / std::log((highest + bend) / (1 + bend));
}

cv::Mat ringAverages(int width, int side)
{
    const Rings& rings = ringsOf(width, side);
    cv::Mat rows = cv::Mat::zeros(ringCount, width * width, CV_32F);
    for (int i = 0; i < width * width; ++i)
        if (const RingPair& pair = rings.at(i / width, i % width); pair.lower >= 0) {
            rows.at<float>(pair.lower, i) = 1 - pair.share;
            rows.at<float>(pair.lower + 1, i) = pair.share;
        }
    for (int ring = 0; ring < ringCount; ++ring) {
        const double weight = cv::sum(rows.row(ring))[0];
        if (weight > 0)
            rows.row(ring) /= weight;
        else if (ring > 0)
            rows.row(ring - 1).copyTo(rows.row(ring));
    }
    for (int ring = ringCount - 2; ring >= 0; --ring)
        if (cv::countNonZero(rows.row(ring)) == 0) rows.row(ring + 1).copyTo(rows.row(ring));
    return rows;
}

std::vector<float> ringPowers(const cv::Mat& heightMm, int side)
{
    const cv::Mat map = atLeastAWindow(heightMm, side);
    const int width = widthOfWindows(map.size(), side);
    const Rings& rings = ringsOf(width, side);
    cv::Mat sums = cv::Mat::zeros(width, width, CV_32F);
    int windows = 0;
    for (const int row : cornersAlong(map.rows, width))
        for (const int column : cornersAlong(map.cols, width)) {
            addPowers(map({column, row, width, width}), rings, sums);
            ++windows;
        }
    std::vector<float> powers;
    for (const double mean : averaged(sums, rings))
        powers.push_back(static_cast<float>(std::log(mean / (rings.energy * windows) + ringFloorMm2)));
    return powers;
}

cv::Mat withRingPowers(const cv::Mat& heightMm, const std::vector<float>& wanted, const RingFilter& filter)
{
    std::vector<double> logGain(ringCount, 0);
    const double bound = std::log(filter.mostGain);
    const Spectrum spectrum(heightMm, filter.side / 2);
    cv::Mat made = heightMm;
    for (int pass = 0; pass < filter.passes; ++pass) {
        const std::vector<float> present = ringPowers(made, filter.side);
        for (std::size_t i = 0; i < logGain.size(); ++i)
            logGain[i] = std::clamp(logGain[i] + 0.5 * static_cast<double>(wanted[i] - present[i]), -bound, bound);
        made =
            signals::zeroedRelief(spectrum.times(gainTable(logGain, filter.side)), {1, 1}, std::nullopt, filter.zeroPercentile);
    }
    return made;
}

}  // namespace rendering::models
