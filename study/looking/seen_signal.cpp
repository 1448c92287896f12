#include "study/looking/seen_signal.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <opencv2/core.hpp>

namespace study::looking {

namespace {

constexpr double muchClipped = 0.01;  // share of the pixels
constexpr double muchMissing = 0.001;
constexpr double flatContrast = 2;  // RMS grey levels; below it nothing is visible

/// Computes the moments in two passes, which stays exact for small waves on a large height.
void addMoments(SignalFacts& facts, const std::vector<double>& finite)
{
    if (finite.empty()) return;
    double sum = 0, squares = 0;
    for (const double value : finite) sum += value;
    const double mean = sum / static_cast<double>(finite.size());
    for (const double value : finite) squares += (value - mean) * (value - mean);
    const auto [low, high] = std::minmax_element(finite.begin(), finite.end());
    facts.min = *low;
    facts.max = *high;
    facts.mean = std::clamp(mean, *low, *high);
    facts.sq = std::sqrt(squares / static_cast<double>(finite.size()));
}

double share(std::size_t part, std::size_t whole)
{
    return whole == 0 ? 0 : static_cast<double>(part) / static_cast<double>(whole);
}

SignalFacts factsOfMap(const SeenMap& map)
{
    SignalFacts facts;
    std::vector<double> finite;
    finite.reserve(map.values.total());
    for (const float value : cv::Mat_<float>(map.values))
        if (std::isfinite(value)) finite.push_back(value);
    addMoments(facts, finite);
    facts.missingShare = share(map.values.total() - finite.size(), map.values.total());
    if (!map.storedRange) return facts;
    std::size_t low = 0, high = 0;
    for (const unsigned char mark : cv::Mat_<unsigned char>(map.clipped)) {
        low += mark & 1u;
        high += (mark >> 1) & 1u;
    }
    facts.clippedLowShare = share(low, map.values.total());
    facts.clippedHighShare = share(high, map.values.total());
    return facts;
}

SignalFacts factsOfTrace(const SeenTrace& trace)
{
    SignalFacts facts;
    std::vector<double> finite;
    std::copy_if(trace.values.begin(), trace.values.end(), std::back_inserter(finite), [](double v) { return std::isfinite(v); });
    addMoments(facts, finite);
    facts.missingShare = share(trace.values.size() - finite.size(), trace.values.size());
    return facts;
}

std::string percent(double share)
{
    if (share == 0) return "0 %";
    if (share < 0.0005) return "less than 0.1 %";
    const long tenths = std::lround(share * 1000);
    return std::to_string(tenths / 10) + (tenths % 10 == 0 ? "" : "." + std::to_string(tenths % 10)) + " %";
}

}  // namespace

std::string figure(double value)
{
    std::array<char, 32> text{};
    const double size = std::abs(value);
    const bool isPlain = size == 0 || (size >= 1e-4 && size < 1e5);
    // Three significant digits; whole numbers have no decimals.
    const int decimals = size == 0 || value == std::round(value)
                             ? 0
                             : std::clamp(2 - static_cast<int>(std::floor(std::log10(size * 1.0005))), 0, 6);
    const auto end = isPlain ? std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed, decimals)
                             : std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::scientific, 2);
    return {text.data(), end.ptr};
}

std::string roughFigure(double value)
{
    std::array<char, 32> text{};
    const bool isWhole = std::abs(value) >= 10 && std::abs(value) < 1e5;
    const auto end = isWhole ? std::to_chars(text.data(), text.data() + text.size(), std::lround(value))
                             : std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, 2);
    return {text.data(), end.ptr};
}

SignalFacts factsOf(const SeenSignal& signal)
{
    const auto* map = std::get_if<SeenMap>(&signal.what);
    return map ? factsOfMap(*map) : factsOfTrace(std::get<SeenTrace>(signal.what));
}

std::vector<std::string> linesOf(const SeenSignal& signal, const SignalFacts& facts)
{
    const auto* map = std::get_if<SeenMap>(&signal.what);
    const std::string unit = map && !map->unit.empty() ? " " + map->unit : "";
    const std::string missing = map ? "missing (NaN) " : std::get<SeenTrace>(signal.what).whyMissing + " ";
    std::vector<std::string> lines;
    if (facts.min) lines.push_back("min " + figure(*facts.min) + "   max " + figure(*facts.max) + unit);
    if (facts.mean) lines.push_back("mean " + figure(*facts.mean) + (map ? "   Sq " : "   SD ") + figure(*facts.sq) + unit);
    std::string shares = missing + percent(facts.missingShare);
    if (facts.clippedLowShare)
        shares = "clipped: " + percent(*facts.clippedLowShare) + " at 0, " + percent(*facts.clippedHighShare) + " at " +
                 figure(map->storedRange->highest);
    lines.push_back(shares);
    return lines;
}

std::vector<std::string> warningsOf(const SeenSignal& signal, const SignalFacts& facts)
{
    const auto* map = std::get_if<SeenMap>(&signal.what);
    std::vector<std::string> warnings;
    if (const std::size_t rows = map ? 0 : std::get<SeenTrace>(signal.what).droppedRows; rows > 0)
        warnings.push_back(std::to_string(rows) + (rows == 1 ? " row is not shown: its" : " rows are not shown: their") +
                           " time or place is missing or does not increase.");
    const double clipped = facts.clippedLowShare.value_or(0) + facts.clippedHighShare.value_or(0);
    if (!facts.min)
        warnings.emplace_back("The signal contains no numbers.");
    else if (*facts.min == *facts.max)
        warnings.emplace_back("All values are equal.");
    else if (map && map->storedRange && *facts.sq < flatContrast * map->storedRange->highest / 255)
        warnings.emplace_back("The picture has hardly any contrast.");
    if (clipped > muchClipped && facts.min && *facts.min != *facts.max)
        warnings.push_back(percent(clipped) + " of the pixels are clipped; their true values are lost.");
    if (facts.missingShare > muchMissing && facts.min)
        warnings.push_back(percent(facts.missingShare) +
                           (map ? " of the points are missing."
                                : " of the samples are missing: " + std::get<SeenTrace>(signal.what).whyMissing + "."));
    if (map && map->beginsAtZero && facts.min && *facts.min < -1e-6) warnings.emplace_back("Some heights are below 0.");
    return warnings;
}

}  // namespace study::looking
