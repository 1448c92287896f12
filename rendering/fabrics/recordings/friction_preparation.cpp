#include "rendering/fabrics/recordings/friction_preparation.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>

#include "protocols/files/errors.h"
#include "protocols/files/number_text.h"
#include "rendering/fabrics/friction_record.h"

namespace rendering::fabrics {

namespace {

constexpr double mostNormalN = 1000;    ///< a probe that strokes a fabric does not press as hard as a person weighs
constexpr double mostCoefficient = 10;  ///< above it the two forces have different units
constexpr double oddCoefficient = 2, tinyCoefficient = 0.005;
constexpr double silentCoefficient = 1e-9;  ///< what rounding leaves of a constant offset after its zero is subtracted
constexpr double leastSpeedMmPerS = 1e-3, mostSpeedMmPerS = 1e5;
constexpr double fewSamplesHz = 5;    ///< a stroke is rarely sampled so slowly
constexpr double mostLeftOut = 0.01;  ///< share of the slide's samples
constexpr std::size_t mostSamples = 50'000'000;

double meanOf(const std::vector<double>& values, RowRange rows)
{
    const auto begin = values.begin();
    return std::accumulate(begin + std::ptrdiff_t(rows.begin), begin + std::ptrdiff_t(rows.end), 0.0) / double(rows.count());
}

/// Rows whose time lies in an interval.
RowRange rowsIn(const std::vector<double>& timeS, const TimeInterval& interval, const std::string& where,
                const std::string& option)
{
    const auto first = std::lower_bound(timeS.begin(), timeS.end(), interval.fromS) - timeS.begin();
    const auto last = std::upper_bound(timeS.begin(), timeS.end(), interval.toS) - timeS.begin();
    if (last - first < 2)
        throw protocols::badInput(
            {"has fewer than two samples from " + fourFigures(interval.fromS) + " to " + fourFigures(interval.toS) + " s", where,
             "an interval within " + fourFigures(timeS.back()) + " s", "correct " + option});
    return {std::size_t(first), std::size_t(last)};
}

void subtract(std::vector<double>& values, double zero)
{
    for (double& value : values) value -= zero;
}

void subtractZero(PreparedRecord& result, std::vector<double>& second, const RawRecord& record, const FrictionOptions& options)
{
    if (options.zero == Selection::None) return;
    result.zeroRows = options.zero == Selection::Stated ? rowsIn(result.timeS, options.zeroInterval, record.where, "--zero")
                                                        : unloadedRows(result.normalN);
    result.lacksZero = !result.zeroRows;
    if (!result.zeroRows) return;
    result.zeroNormalN = meanOf(result.normalN, *result.zeroRows);
    subtract(result.normalN, result.zeroNormalN);
    for (auto* axis : {&result.tangentialN, &second}) {
        if (axis->empty()) continue;
        result.zeroTangentialN.push_back(meanOf(*axis, *result.zeroRows));
        subtract(*axis, result.zeroTangentialN.back());
    }
}

/// Many sensors give compression a negative sign. The sign of all loaded samples together decides.
void makeCompressionPositive(PreparedRecord& result, const FrictionOptions& options)
{
    if (options.normal) return;
    const double least = loadedLevel(result.normalN) / 2;
    std::ptrdiff_t sign = 0;
    for (const double force : result.normalN)
        if (std::abs(force) >= least) sign += force < 0 ? -1 : 1;
    result.normalReversed = sign < 0;
    if (result.normalReversed)
        for (double& force : result.normalN) force = -force;
}

void requirePlausibleForces(const PreparedRecord& result, const std::string& where)
{
    const double load = loadedLevel(result.normalN);
    if (load > leastNormalN && load <= mostNormalN) return;
    throw protocols::badInput({"the normal force is " + fourFigures(load) + " N under load", where, "0.05 to 1000 N",
                               "state the unit (--force-unit mN or gf) or the axis (--normal)"});
}

Slide slideOf(const PreparedRecord& result, const RawRecord& record, const FrictionOptions& options)
{
    const std::size_t count = result.timeS.size();
    if (options.trim == Selection::Stated) {
        const RowRange rows = rowsIn(result.timeS, options.trimInterval, record.where, "--trim");
        return {{0, count}, rows, ""};
    }
    if (options.trim == Selection::None) return {{0, count}, {0, count}, "by option"};
    if (result.normalN.empty() && record.quantity != "mu") return {{0, count}, {0, count}, "there is no coefficient"};
    return steadySlide(result.normalN, result.tangentialN);
}

/// Stamps and samples of the steady part, without samples of too little normal force.
struct Kept {
    std::vector<double> timeS, values, normalN;
};

Kept keptOf(PreparedRecord& result, const std::string& where)
{
    const RowRange rows = result.slide.steady;
    double least = 0;
    if (!result.normalN.empty()) {
        const auto begin = result.normalN.begin();
        std::vector<double> loads(begin + std::ptrdiff_t(rows.begin), begin + std::ptrdiff_t(rows.end));
        const auto middle = loads.begin() + std::ptrdiff_t(loads.size() / 2);
        std::nth_element(loads.begin(), middle, loads.end());
        least = std::max(leastShareOfLoad * *middle, leastNormalN);
    }
    Kept kept;
    std::optional<std::size_t> firstLost;
    for (std::size_t i = rows.begin; i < rows.end; ++i) {
        if (!result.normalN.empty() && !(result.normalN[i] > least)) {
            if (!firstLost) firstLost = i;
            ++result.leftOut;
            continue;
        }
        kept.timeS.push_back(result.timeS[i]);
        kept.values.push_back(result.tangentialN[i]);
        if (!result.normalN.empty()) kept.normalN.push_back(result.normalN[i]);
    }
    if (double(result.leftOut) > mostLeftOut * double(rows.count()))
        throw protocols::badInput(
            {"the normal force is " + fourFigures(result.normalN[*firstLost]) + " N in the slide; it is too small in " +
                 std::to_string(result.leftOut) + " of " + std::to_string(rows.count()) + " samples",
             where + ", row " + std::to_string(*firstLost + 1),
             "more than " + fourFigures(least) + " N (a quarter of the median, at least 0.05 N), so that the probe is in contact",
             "cut the record to the stroke with --trim FROM,TO"});
    return kept;
}

void resample(PreparedRecord& result, const Kept& kept, const std::string& where, std::optional<double> rateHz)
{
    result.base = timeBaseOf(kept.timeS, where);
    const double duration = kept.timeS.back() - kept.timeS.front(), ownS = duration / double(kept.timeS.size() - 1);
    const bool asItIs = result.base.even && result.leftOut == 0 && !rateHz;
    result.stepS = asItIs ? ownS : rateHz ? 1 / *rateHz : result.base.stepS;
    // A single wrong stamp must not produce a record of hours.
    const double most = rateHz ? double(mostSamples) : 20 * double(kept.timeS.size()) + 1000;
    if (!(duration / result.stepS <= most))
        throw protocols::badInput({"has a gap in time that is too long to fill", where, "time stamps of one stroke",
                                   "cut the record to the stroke with --trim FROM,TO"});
    if (rateHz && duration < result.stepS)
        throw protocols::badInput({"lasts " + fourFigures(duration) + " s, which is less than a period of --rate", where,
                                   "at least one period", "choose a higher --rate"});
    const bool averages = rateHz && result.stepS >= 2 * ownS;
    result.resampling = asItIs ? "none" : averages ? "mean over each period" : "linear between neighbours";
    const auto even = [&](const std::vector<double>& values) {
        if (asItIs || values.empty()) return values;
        return averages ? meansAtEvenSteps(kept.timeS, values, result.stepS) : atEvenSteps(kept.timeS, values, result.stepS);
    };
    result.values = even(kept.values);
    result.evenNormalN = even(kept.normalN);
    if (result.base.largestS > longestGapSteps * result.base.stepS)
        result.warnings.push_back("a straight line fills a gap of " + fourFigures(result.base.largestS) + " s");
}

/// A wrong unit of time is a wrong rate: stamps in nanoseconds that are read as seconds give 1e-7 Hz.
void requirePlausibleRate(double stepS, const RawRecord& record)
{
    constexpr double rounding = 1e-9;
    const double rateHz = 1 / stepS;
    if (rateHz >= leastRateHz && rateHz <= mostRateHz * (1 + rounding)) return;
    throw protocols::badInput(
        {"the time stamps give a sample rate of " + fourFigures(rateHz) + " Hz", record.where, "0.001 to 10,000,000 Hz",
         record.timeWithoutUnit.empty() ? "correct the time stamps or their unit"
                                        : "state the unit of time in the column's name, such as time_ms, time_us or time_ns"});
}

/// Rows at rest or in a ramp are cut from the record, so they must not count for its speed either.
std::optional<double> speedIn(const RawRecord& record, RowRange rows)
{
    if (record.speedsMmPerS.size() != record.timeS.size() || rows.count() == 0) return record.speedMmPerS;
    const auto begin = record.speedsMmPerS.begin();
    const double sum = std::accumulate(begin + std::ptrdiff_t(rows.begin), begin + std::ptrdiff_t(rows.end), 0.0);
    return record.speedMmPerS ? std::optional(std::abs(sum / double(rows.count()))) : std::nullopt;
}

void requirePlausibleSpeed(std::optional<double> speedMmPerS, const RawRecord& record)
{
    if (!speedMmPerS || (*speedMmPerS >= leastSpeedMmPerS && *speedMmPerS <= mostSpeedMmPerS)) return;
    throw protocols::badInput({"the speed is " + fourFigures(*speedMmPerS) + " mm/s", record.where, "0.001 to 100,000 mm/s",
                               "correct the speed in the file or in its name"});
}

/// A cable that is out, or a wrong column, is no friction of 0.
void requireSignal(const PreparedRecord& result, const RawRecord& record)
{
    if (std::abs(result.mean) > silentCoefficient || result.sd > silentCoefficient) return;
    if (record.normalN.empty())
        throw protocols::badInput({"the coefficient of friction is 0 throughout", record.where, "a coefficient above 0",
                                   "check the sensor and the column of the coefficient"});
    throw protocols::badInput({"the tangential force is 0 throughout", record.where, "a force while the probe slides",
                               "check the cable of the sensor, and name the column with --tangential"});
}

void measure(PreparedRecord& result, const RawRecord& record)
{
    const auto at = [&](std::size_t i) {
        return result.evenNormalN.empty() ? result.values[i] : result.values[i] / result.evenNormalN[i];
    };
    const auto isFinite = [](double value) { return std::isfinite(value); };
    if (!std::ranges::all_of(result.values, isFinite) || !std::ranges::all_of(result.evenNormalN, isFinite))
        throw protocols::badInput({"a value exceeds the range of 64-bit numbers", record.where, "finite forces in N",
                                   "correct the record or the unit of its columns"});
    const auto count = double(result.values.size());
    for (std::size_t i = 0; i < result.values.size(); ++i) result.mean += at(i) / count;
    for (std::size_t i = 0; i < result.values.size(); ++i) result.sd += std::pow(at(i) - result.mean, 2) / count;
    result.sd = std::sqrt(result.sd);
    const bool coefficient = !record.normalN.empty() || record.quantity == "mu";
    if (!std::isfinite(result.mean) || !std::isfinite(result.sd) || (coefficient && std::abs(result.mean) > mostCoefficient))
        throw protocols::badInput(
            {"the mean coefficient is " + fourFigures(result.mean), record.where, "at most 10",
             "check that both forces have the stated unit (--force-unit, or a unit in the name of each column)"});
    if (!coefficient) return;
    requireSignal(result, record);
    if (std::abs(result.mean) > oddCoefficient || std::abs(result.mean) < tinyCoefficient)
        result.warnings.push_back("a mean coefficient of " + fourFigures(result.mean) +
                                  " is unusual: check that both forces have the same unit");
    if (result.mean < 0)
        result.warnings.push_back(
            "the coefficient is negative: the tangential axis points against the stroke (use --tangential=-NAME)");
}

/// Forces of two axes along the line on which most of the force lies. A stroke back has the other sign there.
std::vector<double> alongMainLine(std::vector<double> x, const std::vector<double>& y)
{
    double largest = 0, xx = 0, yy = 0, xy = 0;
    for (std::size_t i = 0; i < x.size(); ++i) largest = std::max({largest, std::abs(x[i]), std::abs(y[i])});
    if (!(largest > 0)) return x;
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double a = x[i] / largest, b = y[i] / largest;  // squares of huge forces are no numbers
        xx += a * a;
        yy += b * b;
        xy += a * b;
    }
    const double angle = std::atan2(2 * xy, xx - yy) / 2;
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = std::cos(angle) * x[i] + std::sin(angle) * y[i];
    return x;
}

std::string wholePercent(double share) { return std::to_string(std::lround(100 * share)) + " %"; }

/// The mean over strokes back and forth is no friction. `first` and `second` are the tangential axes before they are combined.
void requireOneDirection(PreparedRecord& result, const RawRecord& record, const std::vector<double>& first,
                         const std::vector<double>& second)
{
    constexpr double leastOfEach = 0.05, leastOfBoth = 0.8;  // shares of the slide's samples
    if (result.normalN.empty() && record.quantity != "mu") return;
    const auto directionsIn = [&](RowRange rows) {
        const auto part = [&](const std::vector<double>& values) {
            return std::vector<double>(values.begin() + std::ptrdiff_t(rows.begin), values.begin() + std::ptrdiff_t(rows.end));
        };
        return directionsOf(second.empty() ? part(result.tangentialN) : alongMainLine(part(first), part(second)));
    };
    const auto& [contact, slide, why] = result.slide;
    const StrokeDirections found = directionsIn(slide);
    const double load = result.normalN.empty() ? 1 : loadedLevel(result.normalN);
    if (!(found.medianMagnitude > tinyCoefficient * load)) return;  // such a force may be the drift of the sensor
    if (std::min(found.positive, found.negative) <= leastOfEach) return;
    const std::string shares = "the tangential force points one way in " + wholePercent(found.positive) +
                               " and the other way in " + wholePercent(found.negative) + " of the slide";
    if (found.positive + found.negative < leastOfBoth) {
        result.warnings.push_back(shares + ": check that the record is one stroke in one direction");
        return;
    }
    // A whole stroke where the contact shows it: the slide may begin within the first.
    const RowRange whole = directionsIn(contact).longest, cut = found.longest;
    const RowRange stroke = whole.count() > 0 ? RowRange{contact.begin + whole.begin, contact.begin + whole.end}
                                              : RowRange{slide.begin + cut.begin, slide.begin + cut.end};
    const auto timeAt = [&](std::size_t row) { return protocols::shortest(std::round(1000 * result.timeS[row]) / 1000); };
    throw protocols::badInput(
        {"the stroke runs in both directions: " + shares, record.where + ", row " + std::to_string(slide.begin + found.turn + 1),
         "one stroke in one direction",
         "cut the record to one stroke, such as --trim " + timeAt(stroke.begin) + "," + timeAt(stroke.end - 1)});
}

}  // namespace

std::string fourFigures(double value)
{
    char buffer[40];
    const auto [end, problem] = std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::general, 4);
    return std::string(buffer, problem == std::errc{} ? end : buffer);
}

PreparedRecord prepare(const RawRecord& record, const FrictionOptions& options)
{
    requirePlausibleRate(timeBaseOf(record.timeS, record.where).stepS, record);
    requirePlausibleSpeed(record.speedMmPerS, record);
    PreparedRecord result;
    result.timeS = record.timeS;
    subtract(result.timeS, record.timeS.front());
    result.tangentialN = record.values;
    result.normalN = record.normalN;
    auto second = record.secondTangentialN;
    if (!result.normalN.empty()) {
        subtractZero(result, second, record, options);
        makeCompressionPositive(result, options);
        requirePlausibleForces(result, record.where);
    }
    const auto first = second.empty() ? std::vector<double>{} : result.tangentialN;
    for (std::size_t i = 0; i < second.size(); ++i) result.tangentialN[i] = std::hypot(result.tangentialN[i], second[i]);
    result.slide = slideOf(result, record, options);
    result.speedMmPerS = speedIn(record, result.slide.steady);
    requirePlausibleSpeed(result.speedMmPerS, record);
    const Kept kept = keptOf(result, record.where);
    resample(result, kept, record.where, options.rateHz);
    requirePlausibleRate(result.stepS, record);
    measure(result, record);
    requireOneDirection(result, record, first, second);
    if (result.values.size() < shortestTrace)
        result.warnings.push_back("the record has only " + std::to_string(result.values.size()) +
                                  " samples; a friction image needs " + std::to_string(shortestTrace));
    if (!record.timeWithoutUnit.empty() && 1 / result.base.stepS < fewSamplesHz)
        result.warnings.push_back("the column \"" + record.timeWithoutUnit + "\" states no unit, and in s it gives " +
                                  fourFigures(1 / result.base.stepS) + " Hz: if its unit is ms or us, add that to its name");
    return result;
}

}  // namespace rendering::fabrics
