#include "rendering/composition/image_warnings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace rendering {

namespace {

constexpr int rings = 16;
constexpr int middlePx = 512;
constexpr double quietPower = 1e-2;  ///< squared grey levels in a ring; less is rounding

using RingPowers = std::array<double, rings>;

/// Grey levels of 255 in one level of the image.
double greyLevelsPerLevel(const cv::Mat& image) { return image.depth() == CV_16U ? 255.0 / 65535 : 1; }

double hann(int place, int length) { return 0.5 - 0.5 * std::cos(2 * CV_PI * (place + 0.5) / length); }

/// Window and rings of one size of the middle, computed once for all images.
struct RingTable {
    cv::Size size;
    cv::Mat window;         ///< CV_32FC1
    std::vector<int> ring;  ///< of each frequency, row by row; -1: too slow to count
};

RingTable ringTable(cv::Size size)
{
    RingTable table{size, cv::Mat(size, CV_32FC1), {}};
    const double lowest = 2.0 / std::max(size.width, size.height), octaves = std::log2(0.5 / lowest);
    for (int i = 0; i < size.height; ++i)
        for (int j = 0; j < size.width; ++j) {
            table.window.at<float>(i, j) = static_cast<float>(hann(i, size.height) * hann(j, size.width));
            const double fy = std::min(i, size.height - i) / static_cast<double>(size.height),
                         fx = std::min(j, size.width - j) / static_cast<double>(size.width), f = std::hypot(fx, fy);
            const double ring = octaves > 0 ? std::log2(f / lowest) / octaves * rings : 0;
            table.ring.push_back(f < lowest / 2 ? -1 : static_cast<int>(std::clamp(ring, 0.0, rings - 1.0)));
        }
    return table;
}

cv::Size middleSizeOf(const cv::Mat& image) { return {std::min(image.cols, middlePx), std::min(image.rows, middlePx)}; }

/// Power of the variation in rings of frequency that grow by equal factors, squared grey levels.
RingPowers ringPowers(const cv::Mat& image, const RingTable& table)
{
    const cv::Size size = table.size;
    cv::Mat middle, spectrum;
    image(cv::Rect({(image.cols - size.width) / 2, (image.rows - size.height) / 2}, size))
        .convertTo(middle, CV_32F, greyLevelsPerLevel(image));
    middle -= cv::mean(middle)[0];
    cv::multiply(middle, table.window, middle);
    cv::dft(middle, spectrum, cv::DFT_COMPLEX_OUTPUT);
    RingPowers powers{};
    // The window passes 9/64 of the power; the transform sums over all pixels.
    const double unit = 64.0 / 9 / std::pow(static_cast<double>(size.area()), 2);
    auto ring = table.ring.begin();
    for (int i = 0; i < size.height; ++i) {
        const auto* value = spectrum.ptr<cv::Vec2f>(i);
        for (int j = 0; j < size.width; ++j, ++ring)
            if (*ring >= 0) powers[static_cast<std::size_t>(*ring)] += unit * static_cast<double>(value[j].dot(value[j]));
    }
    return powers;
}

/// What comparisons need of an image, computed once.
struct SeenImage {
    cv::Mat image;  ///< shares the pixels
    double mean = 0;
    RingPowers powers{};
};

SeenImage seen(const cv::Mat& image, const RingTable& table)
{
    return {image, cv::mean(image)[0] * greyLevelsPerLevel(image), ringPowers(image, table)};
}

ImageDistance between(const SeenImage& a, const SeenImage& b)
{
    double squares = 0;
    for (std::size_t k = 0; k < rings; ++k)
        squares += std::pow(10 * std::log10((a.powers[k] + quietPower) / (b.powers[k] + quietPower)), 2);
    const double levels = cv::norm(a.image, b.image) * greyLevelsPerLevel(a.image);
    return {levels / std::sqrt(static_cast<double>(a.image.total())), std::abs(a.mean - b.mean), std::sqrt(squares / rings)};
}

template <class Level>
std::vector<std::size_t> levelCounts(const cv::Mat& image)
{
    std::vector<std::size_t> counts(std::size_t{1} << (8 * sizeof(Level)), 0);
    for (int i = 0; i < image.rows; ++i)
        for (const Level *level = image.ptr<Level>(i), *end = level + image.cols; level != end; ++level) ++counts[*level];
    return counts;
}

/// Difference of the 0.1st and the 99.9th percentile of the levels, as a share of all levels.
double rangeUsed(const cv::Mat& image)
{
    const auto counts = image.depth() == CV_16U ? levelCounts<std::uint16_t>(image) : levelCounts<std::uint8_t>(image);
    const auto at = [&](double share) {
        auto left = static_cast<std::size_t>(share * (static_cast<double>(image.total()) - 1));
        std::size_t level = 0;
        while (left >= counts[level]) left -= counts[level++];
        return static_cast<double>(level);
    };
    return (at(0.999) - at(0.001)) / (static_cast<double>(counts.size()) - 1);
}

std::string number(double value, int digits)
{
    char text[32];
    std::snprintf(text, sizeof text, "%d", static_cast<int>(std::lround(value * std::pow(10, digits))));
    std::string result(text);
    if (digits == 0) return result;
    while (static_cast<int>(result.size()) <= digits) result.insert(0, "0");
    return result.insert(result.size() - static_cast<std::size_t>(digits), ".");
}

std::string listed(const std::vector<std::string>& names)
{
    std::string text;
    for (const auto& name : names) text += (text.empty() ? "" : ", ") + name;
    return text;
}

}  // namespace

ImageDistance distanceOf(const cv::Mat& a, const cv::Mat& b)
{
    const RingTable table = ringTable(middleSizeOf(a));
    return between(seen(a, table), seen(b, table));
}

ImageFaults imageFaults(const RenderedFabrics& rendering)
{
    ImageFaults faults;
    std::optional<RingTable> table;
    std::map<protocols::FabricId, std::vector<std::pair<protocols::ConditionId, SeenImage>>> byFabric;
    for (const auto& rendered : rendering.conditions)
        for (const auto& [fabric, image] : rendered.images) {
            if (!table || table->size != middleSizeOf(image)) table = ringTable(middleSizeOf(image));
            auto one = seen(image, *table);
            if (const double used = rangeUsed(image); used < leastRangeUsed)
                faults.flat.push_back({fabric, rendered.condition, used});
            for (const auto& [condition, other] : byFabric[fabric])
                if (const auto distance = between(other, one); distance.same())
                    faults.same.push_back({fabric, condition, rendered.condition, distance});
            byFabric[fabric].emplace_back(rendered.condition, std::move(one));
        }
    return faults;
}

std::vector<std::string> describe(const ImageFaults& faults, const RenderedFabrics& rendering)
{
    std::vector<std::string> lines;
    std::vector<std::pair<protocols::ConditionId, protocols::ConditionId>> pairs;
    for (const auto& same : faults.same)
        if (std::pair pair(same.first, same.second); std::find(pairs.begin(), pairs.end(), pair) == pairs.end())
            pairs.push_back(pair);
    for (const auto& [first, second] : pairs) {
        std::vector<std::string> names;
        double levels = 0, decibels = 0;
        for (const auto& same : faults.same)
            if (same.first == first && same.second == second) {
                names.push_back(same.fabric.value);
                levels = std::max(levels, same.distance.greyLevels);
                decibels = std::max(decibels, same.distance.decibels);
            }
        lines.push_back("conditions " + first.value + " and " + second.value + " give the same image for " + listed(names) +
                        " (at most " + number(levels, 1) + " grey levels of 255 and " + number(decibels, 1) +
                        " dB apart): no participant can tell them apart there");
    }
    for (const auto& rendered : rendering.conditions) {
        std::vector<std::string> names;
        for (const auto& flat : faults.flat)
            if (flat.condition == rendered.condition)
                names.push_back(flat.fabric.value + " (" + number(100 * flat.rangeUsed, 1) + " %)");
        if (names.empty()) continue;
        const auto& set = rendered.rangeSetBy;
        lines.push_back(
            "condition " + rendered.condition.value + ": less than 10 % of the display's range is used by " + listed(names) +
            (set.highest.value == set.lowest.value
                 ? "; " + set.highest.value + " sets the range"
                 : "; " + set.lowest.value + " sets the lower end of the range, " + set.highest.value + " the upper"));
    }
    return lines;
}

nlohmann::ordered_json jsonOf(const ImageFaults& faults)
{
    nlohmann::ordered_json json{{"same", nlohmann::ordered_json::array()}, {"flat", nlohmann::ordered_json::array()}};
    for (const auto& same : faults.same)
        json["same"].push_back({{"fabric", same.fabric.value},
                                {"conditions", {same.first.value, same.second.value}},
                                {"grey_levels", same.distance.greyLevels},
                                {"mean_levels", same.distance.meanLevels},
                                {"decibels", same.distance.decibels}});
    for (const auto& flat : faults.flat)
        json["flat"].push_back(
            {{"fabric", flat.fabric.value}, {"condition", flat.condition.value}, {"range_used", flat.rangeUsed}});
    return json;
}

std::vector<std::string> mixedQuantities(const RenderedFabrics& rendering)
{
    std::vector<std::string> lines;
    for (const auto& rendered : rendering.conditions) {
        const auto& condition = protocols::conditionNamed(rendered.condition.value);
        if (condition.friction != protocols::FrictionSource::MeasuredTrace) continue;
        // The ranges may come from fabrics that are not shown.
        std::set<std::string> quantities;
        for (const auto& [fabric, image] : rendered.images) quantities.insert(rendering.signals.at(fabric).measuredQuantity);
        if (quantities.size() < 2) continue;
        const std::vector<std::string> names(quantities.begin(), quantities.end());
        lines.push_back("condition " + rendered.condition.value + ": the friction records hold " + std::to_string(names.size()) +
                        " quantities (" + listed(names) +
                        "), each with a range of its own; no finger can compare fabrics of different quantities");
    }
    return lines;
}

std::vector<std::string> frictionOutOfReach(const RenderedFabrics& rendering)
{
    constexpr double worthNaming = 0.001;
    std::vector<std::string> lines;
    for (const auto& rendered : rendering.conditions) {
        std::string fabrics;
        for (const auto& [fabric, facts] : rendered.maps)
            if (facts.outOfReach >= worthNaming) {
                char share[16];
                std::snprintf(share, sizeof share, " %.1f %%", 100 * facts.outOfReach);
                fabrics += (fabrics.empty() ? "" : ", ") + fabric.value + share;
            }
        if (!fabrics.empty())
            lines.push_back(rendered.condition.value + ": no level of the display gives the friction of some pixels: " + fabrics);
    }
    return lines;
}

}  // namespace rendering
