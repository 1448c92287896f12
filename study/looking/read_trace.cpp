#include "study/looking/read_trace.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "protocols/files/errors.h"
#include "protocols/files/foreign/foreign_table.h"
#include "protocols/files/number_text.h"
#include "rendering/fabrics/friction_record.h"
#include "study/looking/place_in_dataset.h"

namespace study::looking {

namespace {

namespace fs = std::filesystem;
using protocols::CsvTable;

constexpr double missingSample = std::numeric_limits<double>::quiet_NaN();
constexpr double leastNormalN = 0.05;  // below this load the coefficient is only noise
constexpr double mostShown = 1e100;    // the squares of larger values are not finite

std::vector<double> columnOf(const protocols::CsvTable& table, std::size_t column)
{
    std::vector<double> values;
    values.reserve(table.rows.size());
    for (const auto& row : table.rows) values.push_back(protocols::numberIn(row[column]).value_or(missingSample));
    return values;
}

std::string joined(const std::vector<std::string>& names)
{
    std::string line;
    for (const std::string& name : names) line += (line.empty() ? "" : ", ") + name;
    return line;
}

/// The column of a coefficient of friction, under any of its usual names.
std::optional<std::size_t> coefficientColumn(const protocols::CsvTable& table)
{
    if (const auto mu = table.column("mu")) return mu;
    for (std::size_t column = 0; column < table.columns.size(); ++column)
        if (rendering::fabrics::quantityNamed(table.columns[column]) == "mu") return column;
    return std::nullopt;
}

/// Takes the friction from the table: tangential over normal force, a coefficient, or the first column that is neither time nor
/// place.
void takeValues(SeenTrace& trace, const protocols::CsvTable& table, const std::string& quantity)
{
    if (!quantity.empty()) {
        const auto column = table.column(quantity);
        if (!column)
            throw protocols::badInput({"has no column " + quantity, table.where, "one of its columns: " + joined(table.columns),
                                       "name one of these columns"});
        trace.values = columnOf(table, *column);
        trace.quantity = quantity;
        return;
    }
    const auto normal = table.column("normal_n"), tangential = table.column("tangential_n"), mu = coefficientColumn(table);
    if (normal && tangential) {
        trace.values = columnOf(table, *tangential);
        const auto load = columnOf(table, *normal);
        for (std::size_t i = 0; i < load.size(); ++i)
            trace.values[i] = load[i] > leastNormalN ? trace.values[i] / load[i] : missingSample;
        trace.quantity = "coefficient of friction";
        trace.whyMissing = "not in contact";
        return;
    }
    for (std::size_t column = 0; column < table.columns.size(); ++column) {
        const std::string& name = table.columns[column];
        if (name == "t_s" || name == "position_mm" || name.starts_with("time") || (mu && column != *mu)) continue;
        trace.values = columnOf(table, column);
        trace.quantity = mu ? "coefficient of friction" : name;
        return;
    }
    throw protocols::badInput({"contains no friction", table.where,
                               "t_s,normal_n,tangential_n or t_s,mu or t_s and one named quantity",
                               "add a column with the measured quantity"});
}

/// Removes samples without a place, and samples whose place does not increase. `times`: time of each sample, or empty.
void keepRising(SeenTrace& trace, std::vector<double>& times)
{
    std::size_t kept = 0;
    for (std::size_t i = 0; i < trace.places.size(); ++i) {
        if (!std::isfinite(trace.places[i]) || (kept > 0 && trace.places[i] <= trace.places[kept - 1])) continue;
        trace.places[kept] = trace.places[i];
        if (!times.empty()) times[kept] = times[i];
        trace.values[kept++] = trace.values[i];
    }
    trace.droppedRows = trace.places.size() - kept;
    trace.places.resize(kept);
    trace.values.resize(kept);
    times.resize(std::min(times.size(), kept));
}

/// Mean rate of rising times, Hz.
std::optional<double> rateOf(const std::vector<double>& times)
{
    if (times.size() < 2 || !std::is_sorted(times.begin(), times.end()) || !(times.back() > times.front())) return std::nullopt;
    return static_cast<double>(times.size() - 1) / (times.back() - times.front());
}

/// Axes need ends, steps and rates that are finite numbers.
void requireDrawable(const SeenTrace& trace, const std::string& where)
{
    const double length = trace.places.back() - trace.places.front();
    const bool hasRates = (!trace.sampleRateHz || std::isnormal(*trace.sampleRateHz)) &&
                          (!trace.samplesPerMm || std::isnormal(*trace.samplesPerMm));
    if (!std::isfinite(length) || !hasRates)
        throw protocols::badInput({"its rows lie between " + figure(trace.places.front()) + " and " +
                                       figure(trace.places.back()) + " " + trace.placeUnit,
                                   where, "times or places whose distance and rate are finite numbers",
                                   "correct the column of times or places, or its unit"});
    const auto large = std::find_if(trace.values.begin(), trace.values.end(), [](double v) { return std::abs(v) > mostShown; });
    if (large != trace.values.end())
        throw protocols::badInput({"contains the value " + figure(*large), where, "values up to " + figure(mostShown),
                                   "correct the row, or name another column with --quantity"});
}

void takePlaces(SeenTrace& trace, const protocols::CsvTable& table, std::optional<double> speedMmPerS)
{
    const auto time = table.column("t_s"), position = table.column("position_mm");
    trace.placeUnit = position || (time && speedMmPerS) ? "mm" : time ? "s" : "samples";
    if (position || time)
        trace.places = columnOf(table, position ? *position : *time);
    else
        for (std::size_t i = 0; i < table.rows.size(); ++i) trace.places.push_back(static_cast<double>(i));
    if (!position && time && speedMmPerS)
        for (double& place : trace.places) place *= *speedMmPerS;
}

}  // namespace

SeenSignal readTrace(const fs::path& file, const ReadingOptions& options)
{
    const protocols::CsvTable table = protocols::readForeignTable(file).table;
    const auto place = placeInDataset(file);
    std::optional<double> speed = options.speedMmPerS;
    if (!speed && place) speed = rendering::fabrics::ownSpeedMmPerS(file).value_or(place->dataset.friction.speedMmPerS);
    SeenTrace trace;
    takeValues(trace, table, options.quantity);
    takePlaces(trace, table, speed);
    const auto timeColumn = table.column("t_s");
    std::vector<double> times = timeColumn ? columnOf(table, *timeColumn) : std::vector<double>{};
    keepRising(trace, times);
    if (trace.places.empty())
        throw protocols::badInput({"contains no samples", file.string(), "at least one row", "record the stroke again"});
    const double gaps = static_cast<double>(trace.places.size() - 1);
    const double length = trace.places.back() - trace.places.front();
    if (trace.placeUnit == "mm" && length > 0) trace.samplesPerMm = gaps / length;
    trace.sampleRateHz = rateOf(times);
    requireDrawable(trace, file.string());
    const std::string rate = trace.sampleRateHz ? ", " + figure(*trace.sampleRateHz) + " Hz" : "";
    return {titleOf(file, place), "friction record, " + std::to_string(trace.places.size()) + " samples" + rate,
            std::move(trace)};
}

}  // namespace study::looking
