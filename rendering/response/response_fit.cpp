#include "rendering/response/response_fit.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "protocols/files/errors.h"
#include "protocols/files/number_text.h"
#include "stats/kernels/distributions.h"

namespace rendering {

namespace {

/// Chance that data without the fault are refused.
constexpr double falseRefusals = 0.001;
/// Without repeats: share of the range by which friction may fall, and of the mean by which it must change.
constexpr double ordinaryScatter = 0.1;

double meanOf(const std::vector<double>& values)
{
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

std::optional<double> meanIfAny(const std::vector<double>& values)
{
    return values.empty() ? std::nullopt : std::optional(meanOf(values));
}

struct Grouped {
    std::vector<MeasuredLevel> levels;
    std::optional<double> noise;
    double df = 0;
};

/// Means by level, and the scatter of repeats about them.
Grouped grouped(const std::vector<FrictionAtLevel>& measurements)
{
    struct Values {
        std::vector<double> all, up, down;
    };
    std::map<int, Values> byLevel;
    for (const auto& one : measurements) {
        auto& values = byLevel[one.level];
        values.all.push_back(one.friction);
        if (one.direction == SweepDirection::Up) values.up.push_back(one.friction);
        if (one.direction == SweepDirection::Down) values.down.push_back(one.friction);
    }
    Grouped result;
    double squares = 0;
    for (const auto& [level, values] : byLevel) {
        const double mean = meanOf(values.all);
        for (const double value : values.all) squares += (value - mean) * (value - mean);
        result.df += static_cast<double>(values.all.size() - 1);
        result.levels.push_back(
            {level, static_cast<int>(values.all.size()), mean, mean, {}, meanIfAny(values.up), meanIfAny(values.down)});
    }
    if (result.df >= 1) result.noise = std::sqrt(squares / result.df);
    const double quantile = result.noise ? stats::studentQuantile(0.025, result.df) : 0;
    if (result.noise)
        for (auto& level : result.levels) level.halfWidth = quantile * *result.noise / std::sqrt(level.count);
    return result;
}

/// Pools neighbours that fall, until nothing falls (Barlow and others, 1972).
void makeIsotonic(std::vector<MeasuredLevel>& levels)
{
    struct Block {
        double sum;
        int count;
        std::size_t levels;
        double mean() const { return sum / count; }
    };
    std::vector<Block> blocks;
    for (const auto& level : levels) {
        blocks.push_back({level.mean * level.count, level.count, 1});
        while (blocks.size() > 1 && blocks[blocks.size() - 2].mean() > blocks.back().mean()) {
            const Block last = blocks.back();
            blocks.pop_back();
            blocks.back().sum += last.sum;
            blocks.back().count += last.count;
            blocks.back().levels += last.levels;
        }
    }
    std::size_t at = 0;
    for (const Block& block : blocks)
        for (std::size_t i = 0; i < block.levels; ++i) levels[at++].fitted = block.mean();
}

/// Monotone cubics (Fritsch and Carlson, 1980) through the fitted levels, one value a grey level.
std::vector<double> curveThrough(const std::vector<MeasuredLevel>& levels)
{
    const std::size_t n = levels.size();
    std::vector<double> width(n - 1), slope(n - 1), tangent(n);
    for (std::size_t i = 0; i + 1 < n; ++i) {
        width[i] = levels[i + 1].level - levels[i].level;
        slope[i] = (levels[i + 1].fitted - levels[i].fitted) / width[i];
    }
    tangent.front() = slope.front();
    tangent.back() = slope.back();
    for (std::size_t i = 1; i + 1 < n; ++i) {
        const double a = 2 * width[i] + width[i - 1], b = width[i] + 2 * width[i - 1];
        tangent[i] = slope[i - 1] > 0 && slope[i] > 0 ? (a + b) / (a / slope[i - 1] + b / slope[i]) : 0;
    }
    std::vector<double> curve{levels.front().fitted};
    for (std::size_t i = 0; i + 1 < n; ++i)
        for (int step = 1; step <= static_cast<int>(width[i]); ++step) {
            const double t = step / width[i], u = 1 - t;
            const double value = levels[i].fitted * (1 + 2 * t) * u * u + levels[i + 1].fitted * (1 + 2 * u) * t * t +
                                 width[i] * t * u * (tangent[i] * u - tangent[i + 1] * t);
            curve.push_back(std::max(value, curve.back()));  // rounding must not make it fall
        }
    return curve;
}

/// Standard error of the difference of two levels' means.
double errorOfDifference(const Grouped& data, const MeasuredLevel& a, const MeasuredLevel& b)
{
    return *data.noise * std::sqrt(1.0 / a.count + 1.0 / b.count);
}

/// Refuses the largest fall of friction between two levels that chance does not explain.
void refuseFalling(const Grouped& data, const std::string& where)
{
    const auto& levels = data.levels;
    const auto [least, most] =
        std::minmax_element(levels.begin(), levels.end(), [](const auto& a, const auto& b) { return a.mean < b.mean; });
    const double pairs = static_cast<double>(levels.size() * (levels.size() - 1)) / 2,
                 quantile = data.noise ? stats::studentQuantile(falseRefusals / pairs, data.df) : 0;
    const MeasuredLevel *from = nullptr, *to = nullptr;
    for (auto a = levels.begin(); a != levels.end(); ++a)
        for (auto b = a + 1; b != levels.end(); ++b) {
            const double allowed =
                data.noise ? quantile * errorOfDifference(data, *a, *b) : ordinaryScatter * (most->mean - least->mean);
            const double fall = a->mean - b->mean;
            if (fall > allowed && (from == nullptr || fall > from->mean - to->mean)) {
                from = &*a;
                to = &*b;
            }
        }
    if (from == nullptr) return;
    throw protocols::badInput({"friction falls from " + protocols::fixed(from->mean, 4) + " at level " +
                                   std::to_string(from->level) + " to " + protocols::fixed(to->mean, 4) + " at level " +
                                   std::to_string(to->level) +
                                   (data.noise ? ", which repeats do not explain" : ", more than a tenth of its range"),
                               where, "friction that rises with the grey level", "check the columns and repeat the measurement"});
}

void refuseFlat(const Grouped& data, const std::string& where)
{
    const auto &first = data.levels.front(), &last = data.levels.back();
    const double change = last.fitted - first.fitted, least = flatShare * (first.fitted + last.fitted) / 2;
    const double needed = data.noise ? stats::studentQuantile(falseRefusals, data.df) * errorOfDifference(data, first, last)
                                     : ordinaryScatter * std::abs(first.mean);
    if (change > needed && change > least) return;
    throw protocols::badInput(
        {"friction does not change with the grey level: " + protocols::fixed(first.fitted, 4) + " at level " +
             std::to_string(first.level) + ", " + protocols::fixed(last.fitted, 4) + " at level " + std::to_string(last.level),
         where, "a difference above " + (needed > least ? protocols::fixed(needed, 4) : "a millionth of the mean friction"),
         "check that the display was on, that the finger was earthed, and that the columns are the right ones"});
}

std::optional<double> hysteresisOf(const std::vector<MeasuredLevel>& levels)
{
    std::vector<double> distances;
    for (const auto& level : levels)
        if (level.up && level.down) distances.push_back(std::abs(*level.down - *level.up));
    return meanIfAny(distances);
}

/// Difference of friction below which a level counts as its end of the curve: that of chance, at least 2 % of the range.
double indistinct(const Grouped& data, const DisplayResponse& response)
{
    const double chance =
        data.noise ? stats::studentQuantile(0.025, data.df) * errorOfDifference(data, data.levels.front(), data.levels.back())
                   : 0;
    return std::min(std::max(chance, reachTolerance * response.range()), response.range() / 2);
}

std::string percentOf(double part, double whole) { return protocols::fixed(100 * part / whole, 1) + " %"; }

}  // namespace

void addDirections(std::vector<FrictionAtLevel>& measurements, const std::vector<bool>& begins)
{
    for (std::size_t i = 0; i < measurements.size(); ++i) {
        if (i == 0 || begins[i]) continue;
        const int before = measurements[i - 1].level, now = measurements[i].level;
        measurements[i].direction = now > before   ? SweepDirection::Up
                                    : now < before ? SweepDirection::Down
                                                   : measurements[i - 1].direction;
    }
    // The first measurements of a sweep move as the next ones do.
    for (std::size_t i = measurements.size(); i-- > 1;)
        if (measurements[i - 1].direction == SweepDirection::Unknown && !begins[i])
            measurements[i - 1].direction = measurements[i].direction;
}

DisplayResponse fitResponse(const std::vector<FrictionAtLevel>& measurements, const std::string& where)
{
    Grouped data = grouped(measurements);
    if (data.levels.size() < fewestLevels)
        throw protocols::badInput(
            {std::to_string(data.levels.size()) + (data.levels.size() == 1 ? " grey level was" : " grey levels were") +
                 " measured",
             where, "at least " + std::to_string(fewestLevels) + " levels; 16 levels, each up and down, are a good measurement",
             "measure more levels between 0 and 255"});
    refuseFalling(data, where);
    makeIsotonic(data.levels);
    refuseFlat(data, where);
    DisplayResponse response;
    response.measured = data.levels;
    response.friction = curveThrough(data.levels);
    response.noise = data.noise;
    response.hysteresis = hysteresisOf(data.levels);
    const double little = indistinct(data, response);
    const auto level = [&](auto found) { return response.lowestLevel() + static_cast<int>(found - response.friction.begin()); };
    const auto& curve = response.friction;
    response.deadUpTo = level(std::upper_bound(curve.begin(), curve.end(), curve.front() + little)) - 1;
    response.saturatedFrom = level(std::lower_bound(curve.begin(), curve.end(), curve.back() - little));
    return response;
}

std::vector<std::string> remarksOn(const DisplayResponse& response)
{
    std::vector<std::string> remarks;
    const double range = response.range();
    if (response.lowestLevel() > 0 || response.highestLevel() < 255)
        remarks.push_back("levels below " + std::to_string(response.lowestLevel()) + " and above " +
                          std::to_string(response.highestLevel()) + " were not measured and are not used");
    if (!response.noise) remarks.emplace_back("no level was measured twice, so the uncertainty is unknown");
    if (response.hysteresis && *response.hysteresis > 0.1 * range)
        remarks.push_back("rising and falling levels differ by " + percentOf(*response.hysteresis, range) +
                          " of the range (hysteresis); the curve lies between them");
    for (std::size_t i = 0; i + 1 < response.measured.size(); ++i) {
        const auto &a = response.measured[i], &b = response.measured[i + 1];
        if (b.fitted - a.fitted > 0.25 * range && b.level - a.level > 1)
            remarks.push_back("between the levels " + std::to_string(a.level) + " and " + std::to_string(b.level) +
                              " friction rises by " + percentOf(b.fitted - a.fitted, range) +
                              " of its range; measure levels between them");
    }
    if (response.noise && *response.noise > 0.1 * range)
        remarks.push_back("one measurement scatters by " + percentOf(*response.noise, range) +
                          " of the range; more repeats make the curve surer");
    return remarks;
}

}  // namespace rendering
