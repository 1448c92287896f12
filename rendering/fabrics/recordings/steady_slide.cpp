#include "rendering/fabrics/recordings/steady_slide.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace rendering::fabrics {

namespace {

double quantile(std::vector<double> values, double share)
{
    const auto place = values.begin() + std::ptrdiff_t(share * double(values.size() - 1));
    std::nth_element(values.begin(), place, values.end());
    return *place;
}

std::vector<double> magnitudes(std::span<const double> values)
{
    std::vector<double> result(values.size());
    std::transform(values.begin(), values.end(), result.begin(), [](double v) { return std::abs(v); });
    return result;
}

/// Longest run above `least`; gaps of up to `bridged` samples do not end it.
RowRange longestRun(std::span<const double> values, double least, std::size_t bridged)
{
    RowRange best, run;
    std::size_t last = 0;
    bool inRun = false;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (!(values[i] >= least)) continue;
        if (!inRun || i - last > bridged + 1) run.begin = i;
        inRun = true;
        last = i;
        run.end = i + 1;
        if (run.count() > best.count()) best = run;
    }
    return best;
}

/// Moving means over `width` samples.
std::vector<double> smoothed(std::span<const double> values, std::size_t width)
{
    std::vector<double> sums(values.size() + 1, 0.0);
    for (std::size_t i = 0; i < values.size(); ++i) sums[i + 1] = sums[i] + values[i];
    std::vector<double> result(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
        const std::size_t from = i - std::min(i, width / 2), to = std::min(values.size(), i + width / 2 + 1);
        result[i] = (sums[to] - sums[from]) / double(to - from);
    }
    return result;
}

/// Line through the middle half of a stroke, and the half width of the band about it.
struct Band {
    double level = 0, slope = 0, centre = 0, width = 0;
    bool holds(double value, std::size_t at) const { return std::abs(value - level - slope * (double(at) - centre)) <= width; }
};

Band bandOf(const std::vector<double>& values, double leastShare)
{
    const std::size_t quarter = values.size() / 4, half = values.size() / 2;
    const auto part = [&](std::size_t from, std::size_t to) {
        return std::vector<double>(values.begin() + std::ptrdiff_t(from), values.begin() + std::ptrdiff_t(to));
    };
    const double early = quantile(part(quarter, half), 0.5), late = quantile(part(half, values.size() - quarter), 0.5);
    Band band{(early + late) / 2, (late - early) / double(quarter), double(half), 0};
    std::vector<double> deviations;
    for (std::size_t i = quarter; i < values.size() - quarter; ++i)
        deviations.push_back(std::abs(values[i] - band.level - band.slope * (double(i) - band.centre)));
    band.width = std::max(1.25 * quantile(std::move(deviations), 0.99), leastShare * std::abs(band.level));
    return band;
}

/// First sample from which `holds` stays true for `length` samples.
template <class Holds>
std::optional<std::size_t> firstStableRun(std::size_t count, std::size_t length, const Holds& holds)
{
    std::size_t run = 0;
    for (std::size_t i = 0; i < count; ++i) {
        run = holds(i) ? run + 1 : 0;
        if (run == length) return i + 1 - length;
    }
    return std::nullopt;
}

/// Steady part of the samples in contact, relative to the first of them.
std::optional<RowRange> steadyPart(const std::vector<double>& coefficient, const std::vector<double>& load)
{
    const std::size_t count = coefficient.size(), length = std::max<std::size_t>(count / 20, 5);
    const std::size_t width = std::max<std::size_t>(count / 200, 1);
    const auto values = smoothed(coefficient, width), forces = smoothed(load, width);
    const Band band = bandOf(values, 0.1), forceBand = load.empty() ? Band{} : bandOf(forces, 0.2);
    const auto holds = [&](std::size_t i) {
        return band.holds(values[i], i) && (forces.empty() || forceBand.holds(forces[i], i));
    };
    const auto begin = firstStableRun(count, length, holds);
    const auto end = firstStableRun(count, length, [&](std::size_t i) { return holds(count - 1 - i); });
    if (!begin || !end || double(*begin) > 0.4 * double(count) || double(*end) > 0.4 * double(count)) return std::nullopt;
    return RowRange{*begin, count - *end};
}

constexpr std::size_t fewestAtRest = 10;

/// Samples at the beginning of a record whose normal force stays at `rest`, within a tenth of the way to `full`.
template <class Force>
std::size_t countAtRest(Force begin, Force end, double rest, double full)
{
    const auto isAtRest = [&](double force) { return std::abs(force - rest) < 0.1 * std::abs(full - rest); };
    return std::size_t(std::find_if_not(begin, end, isAtRest) - begin);
}

/// The same where the first samples show the level; 0 where they are loaded. An approach that begins with the record has no rest:
/// its force changes from sample to sample, and its mean would be a wrong zero.
template <class Force>
std::size_t countAtOwnRest(Force begin, Force end, double full, double load)
{
    constexpr double mostChange = 0.03;  ///< of the way from rest to load; the first tenth of an approach changes by 0.05
    const double rest = quantile(std::vector<double>(begin, begin + std::ptrdiff_t(fewestAtRest)), 0.5);
    if (!(std::abs(rest) < leastShareOfLoad * load)) return 0;
    const auto count = countAtRest(begin, end, rest, full);
    const auto meanFrom = [&](std::size_t first) {
        const auto from = begin + std::ptrdiff_t(first);
        return std::accumulate(from, from + std::ptrdiff_t(count / 2), 0.0) / double(count / 2);
    };
    if (count < fewestAtRest || std::abs(meanFrom(count - count / 2) - meanFrom(0)) > mostChange * std::abs(full - rest))
        return 0;
    return count;
}

}  // namespace

double loadedLevel(std::span<const double> normalN)
{
    auto loads = magnitudes(normalN);
    if (loads.empty()) return 0;
    const double high = quantile(loads, 0.95);
    std::erase_if(loads, [&](double load) { return load < high / 2; });
    return quantile(std::move(loads), 0.5);
}

std::optional<RowRange> unloadedRows(std::span<const double> normalN)
{
    if (normalN.size() < fewestToAnalyse) return std::nullopt;
    const std::vector<double> all(normalN.begin(), normalN.end());
    const double low = quantile(all, 0.02), high = quantile(all, 0.98), load = loadedLevel(normalN);
    // Compression may be negative, so rest is the end of the range that lies nearer to 0.
    const double rest = std::abs(low) < std::abs(high) ? low : high, full = rest == low ? high : low;
    std::size_t before = 0, after = 0;
    if (std::abs(rest) < leastShareOfLoad * load) {
        before = countAtRest(normalN.begin(), normalN.end(), rest, full);
        after = countAtRest(normalN.rbegin(), normalN.rend(), rest, full);
    }
    if (std::max(before, after) < fewestAtRest) {  // A long slide leaves less than 2 % for the rest.
        before = countAtOwnRest(normalN.begin(), normalN.end(), full, load);
        after = countAtOwnRest(normalN.rbegin(), normalN.rend(), full, load);
    }
    if (std::max(before, after) < fewestAtRest || std::max(before, after) == normalN.size()) return std::nullopt;
    // The probe is already moving in the tenth next to the contact, so that tenth is left out.
    return before >= after ? RowRange{0, before - before / 10} : RowRange{normalN.size() - after + after / 10, normalN.size()};
}

Slide steadySlide(std::span<const double> normalN, std::span<const double> tangentialN)
{
    const std::size_t count = tangentialN.size();
    Slide slide{{0, count}, {0, count}, ""};
    if (count < fewestToAnalyse) {
        slide.why = "the record is too short to analyse";
        return slide;
    }
    std::vector<double> coefficient, load;
    if (!normalN.empty()) {
        const auto loads = magnitudes(normalN);
        const double least = leastShareOfLoad * loadedLevel(normalN);
        slide.contact = slide.steady = longestRun(loads, least, count / 100);
        for (std::size_t i = slide.contact.begin; i < slide.contact.end; ++i) {
            load.push_back(loads[i]);
            const double last = coefficient.empty() ? 0 : coefficient.back();
            coefficient.push_back(loads[i] >= least && loads[i] > 0 ? tangentialN[i] / loads[i] : last);
        }
    } else {
        coefficient.assign(tangentialN.begin(), tangentialN.end());
    }
    if (coefficient.size() < fewestToAnalyse) {
        slide.why = "the contact is too short to analyse";
        return slide;
    }
    if (const auto steady = steadyPart(coefficient, load))
        slide.steady = {slide.contact.begin + steady->begin, slide.contact.begin + steady->end};
    else
        slide.why = "no steady part was found";
    return slide;
}

StrokeDirections directionsOf(std::span<const double> signedForce)
{
    constexpr std::size_t fewestInRun = 5;  ///< noise of a coarse sensor keeps its sign for fewer
    StrokeDirections found;
    if (signedForce.empty()) return found;
    found.medianMagnitude = quantile(magnitudes(signedForce), 0.5);
    const auto signAt = [&](std::size_t i) {
        const double force = signedForce[i];
        return std::abs(force) > found.medianMagnitude / 2 ? (force > 0 ? 1 : -1) : 0;
    };
    int firstSign = 0;
    for (std::size_t begin = 0, end = 0; begin < signedForce.size(); begin = end) {
        const int sign = signAt(begin);
        for (end = begin + 1; end < signedForce.size() && signAt(end) == sign;) ++end;
        if (sign == 0 || end - begin < fewestInRun) continue;
        (sign > 0 ? found.positive : found.negative) += double(end - begin) / double(signedForce.size());
        if (end - begin > found.longest.count()) found.longest = {begin, end};
        if (firstSign == 0) firstSign = sign;
        if (sign != firstSign && found.turn == 0) found.turn = begin;
    }
    return found;
}

}  // namespace rendering::fabrics
