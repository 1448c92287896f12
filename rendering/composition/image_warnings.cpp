#include "rendering/composition/image_warnings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <utility>

namespace rendering {

namespace {

constexpr int rings = 16;
constexpr int middlePx = 512;
constexpr double quietPower = 1e-2;  ///< squared grey levels in a ring; less is rounding

using RingPowers = std::array<double, rings>;

/// Grey levels of 255.
cv::Mat levelsFrom(const cv::Mat& image)
{
    cv::Mat levels;
    image.convertTo(levels, CV_32F, image.depth() == CV_16U ? 255.0 / 65535 : 1);
    return levels;
}

double hann(int place, int length) { return 0.5 - 0.5 * std::cos(2 * CV_PI * (place + 0.5) / length); }

/// Power of the variation in rings of frequency that grow by equal factors, squared grey levels.
RingPowers ringPowers(const cv::Mat& levels)
{
    const cv::Size size(std::min(levels.cols, middlePx), std::min(levels.rows, middlePx));
    cv::Mat middle = levels(cv::Rect({(levels.cols - size.width) / 2, (levels.rows - size.height) / 2}, size)).clone();
    middle -= cv::mean(middle)[0];
    for (int i = 0; i < size.height; ++i)
        for (int j = 0; j < size.width; ++j)
            middle.at<float>(i, j) *= static_cast<float>(hann(i, size.height) * hann(j, size.width));
    cv::Mat spectrum;
    cv::dft(middle, spectrum, cv::DFT_COMPLEX_OUTPUT);
    RingPowers powers{};
    const double lowest = 2.0 / std::max(size.width, size.height), octaves = std::log2(0.5 / lowest);
    // The window passes 9/64 of the power; the transform sums over all pixels.
    const double unit = 64.0 / 9 / std::pow(static_cast<double>(size.area()), 2);
    for (int i = 0; i < size.height; ++i)
        for (int j = 0; j < size.width; ++j) {
            const double fy = std::min(i, size.height - i) / static_cast<double>(size.height),
                         fx = std::min(j, size.width - j) / static_cast<double>(size.width), f = std::hypot(fx, fy);
            if (f < lowest / 2) continue;
            const double ring = octaves > 0 ? std::log2(f / lowest) / octaves * rings : 0;
            const auto value = spectrum.at<cv::Vec2f>(i, j);
            powers[static_cast<std::size_t>(std::clamp(ring, 0.0, rings - 1.0))] += unit * static_cast<double>(value.dot(value));
        }
    return powers;
}

/// What comparisons need of an image, computed once.
struct SeenImage {
    cv::Mat levels;
    double mean = 0;
    RingPowers powers{};
};

SeenImage seen(const cv::Mat& image)
{
    const cv::Mat levels = levelsFrom(image);
    return {levels, cv::mean(levels)[0], ringPowers(levels)};
}

ImageDistance between(const SeenImage& a, const SeenImage& b)
{
    double squares = 0;
    for (std::size_t k = 0; k < rings; ++k)
        squares += std::pow(10 * std::log10((a.powers[k] + quietPower) / (b.powers[k] + quietPower)), 2);
    return {cv::norm(a.levels, b.levels) / std::sqrt(static_cast<double>(a.levels.total())), std::abs(a.mean - b.mean),
            std::sqrt(squares / rings)};
}

double rangeUsed(const cv::Mat& levels)
{
    cv::Mat sorted;
    cv::sort(levels.clone().reshape(1, 1), sorted, cv::SORT_EVERY_ROW | cv::SORT_ASCENDING);
    const auto at = [&](double share) { return sorted.at<float>(static_cast<int>(share * (sorted.cols - 1))); };
    return static_cast<double>(at(0.999) - at(0.001)) / 255;
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

ImageDistance distanceOf(const cv::Mat& a, const cv::Mat& b) { return between(seen(a), seen(b)); }

ImageFaults imageFaults(const RenderedFabrics& rendering)
{
    ImageFaults faults;
    std::map<protocols::FabricId, std::vector<std::pair<protocols::ConditionId, SeenImage>>> byFabric;
    for (const auto& rendered : rendering.conditions)
        for (const auto& [fabric, image] : rendered.images) {
            auto one = seen(image);
            if (const double used = rangeUsed(one.levels); used < leastRangeUsed)
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

}  // namespace rendering
