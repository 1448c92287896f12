// Comma-separated friction records: forces over time under common names, and the sliding finger's
// taxel counts.
#include <algorithm>
#include <charconv>
#include <cmath>

#include "protocols/errors.h"
#include "rendering/fabrics/csv_table.h"
#include "rendering/fabrics/import_kinds.h"
#include "rendering/fabrics/import_sources.h"
#include "rendering/whole_file.h"

namespace rendering::fabrics {

namespace {

/// A header such as "Fn [mN]" or "time_ms" taken apart.
struct NameWithUnit {
    std::string name, unit;
};

NameWithUnit takenApart(const std::string& header)
{
    std::string text = lowerCase(header);
    std::replace(text.begin(), text.end(), ' ', '_');
    const auto open = text.find_first_of("([");
    if (open != std::string::npos) {
        const auto close = text.find_first_of(")]", open);
        std::string name = text.substr(0, open);
        while (!name.empty() && name.back() == '_') name.pop_back();
        return {name, text.substr(open + 1, close == std::string::npos ? close : close - open - 1)};
    }
    const auto last = text.rfind('_');
    if (last != std::string::npos)
        for (const std::string_view unit : {"s", "sec", "seconds", "ms", "us", "n", "mn"})
            if (text.substr(last + 1) == unit) return {text.substr(0, last), std::string(unit)};
    return {text, ""};
}

struct Role {
    std::vector<std::string_view> names;
    std::vector<std::pair<std::string_view, double>> units;  ///< factor to s or N; the first is assumed where none is stated
};

const Role timeRole{{"t", "time", "timestamp", "time_stamp", "zeit", "elapsed_time", "step_time"},
                    {{"s", 1}, {"sec", 1}, {"seconds", 1}, {"ms", 1e-3}, {"us", 1e-6}}};
const Role normalRole{{"normal", "normal_force", "fn", "f_n", "force_normal", "load", "normal_load", "fz", "f_z", "n"},
                      {{"n", 1}, {"mn", 1e-3}}};
const Role tangentialRole{{"tangential", "tangential_force", "ft", "f_t", "friction", "friction_force", "lateral_force",
                           "shear_force", "force_tangential", "fx", "f_x"},
                          {{"n", 1}, {"mn", 1e-3}}};
const Role coefficientRole{{"mu", "cof", "coefficient", "friction_coefficient", "coefficient_of_friction"},
                           {{"", 1}, {"-", 1}, {"1", 1}}};

struct Column {
    std::size_t index;
    double factor;
};

/// The column that plays a role; throws badInput for two of them and for a unit that is not known.
std::optional<Column> columnFor(const CsvTable& table, const Role& role)
{
    std::optional<Column> found;
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
        const NameWithUnit header = takenApart(table.columns[i]);
        if (std::find(role.names.begin(), role.names.end(), header.name) == role.names.end()) continue;
        if (found)
            throw protocols::badInput(
                {"both \"" + table.columns[found->index] + "\" and \"" + table.columns[i] + "\" could be meant", table.where,
                 "one column each for time, normal and tangential force", ""});
        const auto unit =
            std::find_if(role.units.begin(), role.units.end(), [&](const auto& known) { return known.first == header.unit; });
        if (unit == role.units.end() && !header.unit.empty())
            throw protocols::badInput(
                {"the unit of the column \"" + table.columns[i] + "\" is not known", table.where, "s, ms, us, N or mN", ""});
        found = Column{i, unit == role.units.end() ? 1.0 : unit->second};
    }
    return found;
}

std::vector<double> columnValues(const CsvTable& table, const Column& column)
{
    std::vector<double> values;
    values.reserve(table.rows.size());
    for (std::size_t row = 0; row < table.rows.size(); ++row)
        values.push_back(column.factor * numberAt(table, row, column.index));
    return values;
}

/// Whichever of the usual separators the header row holds most of.
char separatorIn(std::string_view text)
{
    const std::string_view header = text.substr(0, text.find('\n'));
    const auto countOf = [&](char c) { return std::count(header.begin(), header.end(), c); };
    char best = ',';
    for (const char candidate : {';', '\t'})
        if (countOf(candidate) > countOf(best)) best = candidate;
    return best;
}

/// Speed in a name such as "Denim_F150_V-10mmps_0"; the sign is the direction.
std::optional<double> speedInName(const std::string& stem)
{
    const auto end = stem.find("mmps");
    const auto start = end == std::string::npos ? end : stem.rfind("_V", end);
    if (start == std::string::npos) return std::nullopt;
    const auto speed = numberIn(stem.substr(start + 2, end - start - 2));
    return speed && *speed != 0 ? std::optional(std::abs(*speed)) : std::nullopt;
}

}  // namespace

std::vector<RawRecord> readFrictionCsv(const std::filesystem::path& file)
{
    const std::string bytes = readWholeFile(file);
    const CsvTable table = csvTableFrom(bytes, file.string(), separatorIn(bytes));
    const auto time = columnFor(table, timeRole), normal = columnFor(table, normalRole),
               tangential = columnFor(table, tangentialRole), coefficient = columnFor(table, coefficientRole);
    const bool forces = normal && tangential;
    if (!time || (!forces && !coefficient)) {
        std::string names;
        for (const std::string& name : table.columns) names += (names.empty() ? "" : ", ") + name;
        throw protocols::badInput({"has the columns " + names, table.where,
                                   "time, normal and tangential force (or time and mu), named so in the header",
                                   "rename the columns"});
    }
    RawRecord record;
    record.where = file.string();
    record.instrument = "friction-csv";
    record.timeS = columnValues(table, *time);
    record.values = columnValues(table, forces ? *tangential : *coefficient);
    if (forces) record.normalN = columnValues(table, *normal);
    record.meaning = forces ? "coefficient of friction (tangential over normal force)" : "coefficient of friction";
    return {record};
}

std::vector<RawRecord> readSlide(const std::filesystem::path& file)
{
    const CsvTable table = readCsvTable(file);
    const auto stamp = table.column("timestamp");
    std::vector<std::size_t> taxels;
    for (std::size_t i = 0; i < table.columns.size(); ++i)
        if (table.columns[i].starts_with("channel")) taxels.push_back(i);
    if (!stamp || taxels.empty())
        throw protocols::badInput({"is no sliding record", table.where, "the columns timestamp and channel1, channel2 ...", ""});
    RawRecord record;
    record.where = file.string();
    record.instrument = "slide";
    record.quantity = "taxel_sum_counts";
    record.meaning = "taxel_sum_counts (sum of " + std::to_string(taxels.size()) + " taxels in counts)";
    record.timeS = columnValues(table, {*stamp, 1e-3});
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
        double sum = 0;
        for (const std::size_t taxel : taxels) sum += numberAt(table, row, taxel);
        record.values.push_back(sum);
    }
    record.speedMmPerS = speedInName(file.stem().string());
    return {record};
}

}  // namespace rendering::fabrics
