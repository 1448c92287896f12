#include "rendering/composition/display_mapping.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <opencv2/core.hpp>

namespace rendering {

namespace {

constexpr std::size_t bins = 65536;

/// Noise in [0, 1) that depends on the place but not on the image (splitmix64 of seed and place).
double noiseAt(std::uint64_t seed, std::uint64_t place)
{
    std::uint64_t z = (seed << 32U) + place * 0x9E3779B97F4A7C15U + 0x9E3779B97F4A7C15U;
    z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9U;
    z = (z ^ (z >> 27U)) * 0x94D049BB133111EBU;
    return static_cast<double>((z ^ (z >> 31U)) >> 11U) * 0x1.0p-53;
}

/// Levels of values; an `offset` of 0.5 rounds, noise as `offset` dithers.
template <class Level, class Offset>
cv::Mat levelsOf(const cv::Mat& values, int type, const MapRange& range, double highest, Offset offset)
{
    cv::Mat image(values.size(), type);
    const double gain = highest / (range.max - range.min);
    for (int i = 0; i < values.rows; ++i) {
        const float* value = values.ptr<float>(i);
        Level* level = image.ptr<Level>(i);
        for (int j = 0; j < values.cols; ++j) {
            // Subtracting before scaling keeps the last digits of a narrow range far from 0.
            const double exact = (static_cast<double>(value[j]) - range.min) * gain + offset(i, j);
            level[j] = static_cast<Level>(std::min(std::max(exact, 0.0), highest));
        }
    }
    return image;
}

template <class Level>
cv::Mat levelsOf(const cv::Mat& values, int type, const MapRange& range, const DisplayMapping& mapping)
{
    const double highest = std::pow(2, mapping.bits) - 1;
    if (!mapping.dither) return levelsOf<Level>(values, type, range, highest, [](int, int) { return 0.5; });
    const auto columns = static_cast<std::uint64_t>(values.cols);
    return levelsOf<Level>(values, type, range, highest, [&](int i, int j) {
        return noiseAt(mapping.seed, static_cast<std::uint64_t>(i) * columns + static_cast<std::uint64_t>(j));
    });
}

/// The wanted share of the display's range of friction, 0 to 1.
double wantedShare(float value, const MapRange& range)
{
    return std::clamp((static_cast<double>(value) - range.min) / (range.max - range.min), 0.0, 1.0);
}

/// Levels whose friction is linear in the values.
cv::Mat levelsOfFriction(const cv::Mat& values, const MapRange& range, const DisplayMapping& mapping)
{
    const LevelsOfFriction levels(*mapping.response);
    cv::Mat image(values.size(), CV_8UC1);
    for (int i = 0; i < values.rows; ++i)
        for (int j = 0; j < values.cols; ++j) {
            const double share = wantedShare(values.at<float>(i, j), range);
            const auto place =
                static_cast<std::uint64_t>(i) * static_cast<std::uint64_t>(values.cols) + static_cast<std::uint64_t>(j);
            const int level =
                mapping.dither ? static_cast<int>(levels.between(share) + noiseAt(mapping.seed, place)) : levels.nearest(share);
            image.at<std::uint8_t>(i, j) = static_cast<std::uint8_t>(std::min(level, mapping.response->highestLevel()));
        }
    return image;
}

}  // namespace

void MapRange::include(const ScaledMap& map)
{
    double low = 0, high = 0;
    cv::minMaxLoc(map.values, &low, &high);
    include(low, high);
}

void MapRange::include(double low, double high)
{
    min = empty ? low : std::min(min, low);
    max = empty ? high : std::max(max, high);
    empty = false;
}

RobustRange::RobustRange(const MapRange& whole) : m_whole(whole), m_counts(bins, 0) {}

void RobustRange::include(const ScaledMap& map)
{
    if (m_whole.constant()) return;
    const double gain = static_cast<double>(bins) / (m_whole.max - m_whole.min);
    for (int i = 0; i < map.values.rows; ++i)
        for (int j = 0; j < map.values.cols; ++j) {
            const double bin = (static_cast<double>(map.values.at<float>(i, j)) - m_whole.min) * gain;
            ++m_counts[static_cast<std::size_t>(std::clamp(bin, 0.0, static_cast<double>(bins - 1)))];
        }
}

MapRange RobustRange::between(double lowPercentile, double highPercentile) const
{
    double all = 0;
    for (const auto count : m_counts) all += static_cast<double>(count);
    const double width = (m_whole.max - m_whole.min) / static_cast<double>(bins);
    MapRange range = m_whole;
    double below = 0;
    bool lowFound = false;
    for (std::size_t bin = 0; bin < bins && all > 0; ++bin) {
        below += static_cast<double>(m_counts[bin]);
        if (!lowFound && below > all * lowPercentile / 100) {
            range.min = lowPercentile > 0 ? m_whole.min + static_cast<double>(bin) * width : m_whole.min;
            lowFound = true;
        }
        if (below >= all * highPercentile / 100) {
            range.max = highPercentile < 100 ? m_whole.min + static_cast<double>(bin + 1) * width : m_whole.max;
            break;
        }
    }
    return range.constant() ? m_whole : range;
}

double shareOutside(const ScaledMap& map, const MapRange& range)
{
    const auto outside = [&](int comparison, double bound) {
        return cv::countNonZero(comparison == cv::CMP_LT ? map.values < bound : map.values > bound);
    };
    // Compare in the 32 bits of the map, because the range may begin at the map's least value, rounded in the same way.
    return static_cast<double>(outside(cv::CMP_LT, range.min) + outside(cv::CMP_GT, range.max)) /
           static_cast<double>(map.values.total());
}

cv::Mat frictionOnDisplay(const cv::Mat& image, const DisplayResponse& response)
{
    std::array<std::uint16_t, 256> table{};
    for (int level = 0; level < 256; ++level) {
        const int known = std::clamp(level, response.lowestLevel(), response.highestLevel()) - response.lowestLevel();
        const double share = (response.friction[static_cast<std::size_t>(known)] - response.friction.front()) / response.range();
        table[static_cast<std::size_t>(level)] = static_cast<std::uint16_t>(std::lround(65535 * share));
    }
    cv::Mat friction(image.size(), CV_16UC1);
    for (int i = 0; i < image.rows; ++i)
        for (int j = 0; j < image.cols; ++j) friction.at<std::uint16_t>(i, j) = table[image.at<std::uint8_t>(i, j)];
    return friction;
}

double shareOutOfReach(const ScaledMap& map, const MapRange& range, const DisplayResponse& response)
{
    if (range.constant()) return 0;
    const LevelsOfFriction levels(response);
    std::size_t missed = 0;
    for (int i = 0; i < map.values.rows; ++i)
        for (int j = 0; j < map.values.cols; ++j)
            missed += levels.miss(wantedShare(map.values.at<float>(i, j), range)) > reachTolerance ? 1 : 0;
    return static_cast<double>(missed) / static_cast<double>(map.values.total());
}

cv::Mat mapToDisplay(const ScaledMap& map, const MapRange& range, const DisplayMapping& mapping)
{
    assert((!mapping.response || mapping.bits == 8) && "a response was measured at 256 levels");
    const int type = mapping.bits == 16 ? CV_16UC1 : CV_8UC1;
    if (range.constant()) return cv::Mat::zeros(map.values.size(), type);
    if (mapping.response) return levelsOfFriction(map.values, range, mapping);
    if (mapping.bits == 16) return levelsOf<std::uint16_t>(map.values, type, range, mapping);
    return levelsOf<std::uint8_t>(map.values, type, range, mapping);
}

}  // namespace rendering
