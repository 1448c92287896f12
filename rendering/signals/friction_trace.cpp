#include "rendering/signals/friction_trace.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "protocols/files/errors.h"

namespace rendering::signals {

namespace {

void requireUsable(const fabrics::FrictionRecord& record, const std::string& where)
{
    const auto& values = record.values;
    if (values.size() < static_cast<std::size_t>(shortestTrace))
        throw protocols::badInput({.what = "the friction record has only " + std::to_string(values.size()) + " samples",
                                   .where = where,
                                   .expected = "at least " + std::to_string(shortestTrace) + " samples",
                                   .nextStep = "record a longer stroke"});
    const auto odd = std::find_if_not(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
    if (odd != values.end())
        throw protocols::badInput({.what = "the friction record holds a value that is not a finite number",
                                   .where = where + ", sample " + std::to_string(odd - values.begin() + 1),
                                   .expected = "a finite number in every row",
                                   .nextStep = "correct the row or remove it"});
    if (!(record.sampleRateHz > 0) || !(record.speedMmPerS > 0))
        throw protocols::badInput({.what = "the friction record has no sample rate or stroke speed",
                                   .where = where,
                                   .expected = "sample_rate_hz and speed_mm_per_s above 0 in dataset.json",
                                   .nextStep = "correct dataset.json"});
    const auto& t = record.timeS;
    if (t.empty()) return;
    const auto back = std::adjacent_find(t.begin(), t.end(), [](double a, double b) { return !(b > a); });
    if (t.size() != values.size() || back != t.end())
        throw protocols::badInput({.what = "the time stamps of the friction record do not increase with its samples",
                                   .where = where + ", sample " + std::to_string(back - t.begin() + 1),
                                   .expected = "each time stamp later than the one before",
                                   .nextStep = "sort or cut the record"});
}

/// True where the time stamps lie on the even grid within their rounding.
bool evenlySampled(const std::vector<double>& t, double rateHz)
{
    for (std::size_t i = 0; i < t.size(); ++i)
        if (std::abs((t[i] - t.front()) * rateHz - static_cast<double>(i)) > 0.1) return false;
    return true;
}

double interpolated(const fabrics::FrictionRecord& record, double time)
{
    const auto& t = record.timeS;
    const auto after = std::clamp<std::ptrdiff_t>(std::upper_bound(t.begin(), t.end(), time) - t.begin(), 1,
                                                  static_cast<std::ptrdiff_t>(t.size()) - 1);
    const auto right = static_cast<std::size_t>(after);
    const double share = std::clamp((time - t[right - 1]) / (t[right] - t[right - 1]), 0.0, 1.0);
    return record.values[right - 1] + share * (record.values[right] - record.values[right - 1]);
}

/// Mean of the samples within half a period of `time`; interpolates where there are none.
double averaged(const fabrics::FrictionRecord& record, double time, double periodS)
{
    const auto& t = record.timeS;
    const auto first = std::lower_bound(t.begin(), t.end(), time - periodS / 2) - t.begin();
    const auto last = std::lower_bound(t.begin(), t.end(), time + periodS / 2) - t.begin();
    if (last == first) return interpolated(record, time);
    const auto begin = record.values.begin();
    return std::accumulate(begin + first, begin + last, 0.0) / static_cast<double>(last - first);
}

/// Values at `rateHz`. With fewer than two samples per period an average would only shift them in time, so it interpolates.
std::vector<double> resampled(const fabrics::FrictionRecord& record, double rateHz, double ownRateHz)
{
    const auto& t = record.timeS;
    std::vector<double> values(static_cast<std::size_t>(std::floor((t.back() - t.front()) * rateHz + 1e-6)) + 1);
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double time = t.front() + static_cast<double>(i) / rateHz;
        values[i] = ownRateHz >= 2 * rateHz ? averaged(record, time, 1 / rateHz) : interpolated(record, time);
    }
    return values;
}

}  // namespace

FrictionTrace frictionTrace(const fabrics::FrictionRecord& record, const std::string& where)
{
    requireUsable(record, where);
    FrictionTrace trace{.values = record.values, .quantity = record.quantity, .sampleRateHz = record.sampleRateHz};
    const auto& t = record.timeS;
    const double ownRateHz = t.empty() ? record.sampleRateHz : fabrics::meanRateHz(t, where);
    if (!t.empty() && !evenlySampled(t, record.sampleRateHz)) {
        trace.sampleRateHz = std::min(record.sampleRateHz, ownRateHz);
        trace.values = resampled(record, trace.sampleRateHz, ownRateHz);
        if (trace.values.size() < static_cast<std::size_t>(shortestTrace))
            throw protocols::badInput({.what = "the friction record is too short for its sample rate",
                                       .where = where,
                                       .expected = "at least " + std::to_string(shortestTrace) + " periods",
                                       .nextStep = "record a longer stroke"});
    }
    trace.mean = std::accumulate(trace.values.begin(), trace.values.end(), 0.0) / static_cast<double>(trace.values.size());
    if (record.isCoefficient()) fabrics::requireAxisAlongStroke(trace.mean, where);
    trace.mmPerSample = record.speedMmPerS / trace.sampleRateHz;
    return trace;
}

std::vector<double> atSpacing(std::span<const double> values, double mmPerSample, double wantedMmPerSample)
{
    const double step = wantedMmPerSample / mmPerSample;
    if (std::abs(step - 1) < 1e-6) return {values.begin(), values.end()};
    const double last = static_cast<double>(values.size()) - 1;
    const auto interpolated = [&](double place) {
        const double inside = std::clamp(place, 0.0, last);
        const auto left = static_cast<std::size_t>(inside);
        const std::size_t right = std::min(left + 1, values.size() - 1);
        return values[left] + (inside - static_cast<double>(left)) * (values[right] - values[left]);
    };
    // Several places within a wider step stand for its average.
    const int parts = std::max(1, static_cast<int>(std::ceil(step)));
    std::vector<double> result;
    for (double place = 0; place <= last + 1e-9; place += step) {
        double sum = 0;
        for (int part = 0; part < parts; ++part)
            sum += interpolated(place + ((part + 0.5) / parts - 0.5) * (parts > 1 ? step : 0));
        result.push_back(sum / parts);
    }
    return result;
}

}  // namespace rendering::signals
