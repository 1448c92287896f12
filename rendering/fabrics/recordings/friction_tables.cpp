#include "rendering/fabrics/recordings/friction_tables.h"

#include <algorithm>
#include <cmath>

#include "protocols/files/csv_table.h"
#include "protocols/files/errors.h"
#include "protocols/files/foreign/foreign_table.h"
#include "protocols/files/number_text.h"
#include "protocols/files/whole_file.h"
#include "rendering/fabrics/recordings/column_names.h"
#include "rendering/fabrics/recordings/import_sources.h"
#include "rendering/fabrics/recordings/record_text.h"

namespace rendering::fabrics {

namespace {

/// A quantity and the column names that are recognised for it.
struct ColumnRole {
    std::vector<std::string_view> names;
    const char* what;
};

const ColumnRole timeRole{{"t", "time", "timestamp", "time_stamp", "zeit", "elapsed_time", "step_time"}, "time"};
const ColumnRole normalRole{{"normal", "normal_force", "fn", "f_n", "force_normal", "load", "normal_load", "fz", "f_z", "n"},
                            "normal force"};
const ColumnRole tangentialRole{{"tangential", "tangential_force", "ft", "f_t", "friction", "friction_force", "lateral_force",
                                 "shear_force", "force_tangential"},
                                "tangential force"};
const ColumnRole xRole{{"fx", "f_x", "force_x"}, "force along x"};
const ColumnRole yRole{{"fy", "f_y", "force_y"}, "force along y"};
const ColumnRole coefficientRole{{"mu", "cof", "coefficient", "friction_coefficient", "coefficient_of_friction"}, "coefficient"};

/// Column with the factor that converts it to s or N.
struct CsvColumn {
    std::size_t index;
    double factor = 1;
    std::string name = {};
};

/// Column of a role. Throws badInput where two columns fit.
std::optional<std::size_t> placeFor(const protocols::CsvTable& table, const ColumnRole& role)
{
    std::optional<std::size_t> found;
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
        const std::string name = nameAndUnit(table.columns[i]).name;
        if (std::find(role.names.begin(), role.names.end(), name) == role.names.end()) continue;
        if (found)
            throw protocols::badInput(
                {"both \"" + table.columns[*found] + "\" and \"" + table.columns[i] + "\" could be the " + role.what, table.where,
                 "one column each for time, normal and tangential force", "name the axes with --normal and --tangential"});
        found = i;
    }
    return found;
}

std::optional<CsvColumn> forceFor(const protocols::CsvTable& table, const ColumnRole& role, const FrictionOptions& options)
{
    const auto place = placeFor(table, role);
    if (!place) return std::nullopt;
    const std::string& name = table.columns[*place];
    return CsvColumn{*place, newtonsOf(name, options, table.where), name};
}

/// Column of an axis that the user named, with or without its unit.
CsvColumn columnOf(const protocols::CsvTable& table, const ForceAxis& axis, const FrictionOptions& options)
{
    const std::string wanted = lowerCase(axis.column);
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
        const std::string& name = table.columns[i];
        if (lowerCase(name) != wanted && nameAndUnit(name).name != wanted) continue;
        return {i, axis.sign * newtonsOf(name, options, table.where), name};
    }
    throw protocols::badInput({"has no column \"" + axis.column + "\"", table.where, "a column of the header row",
                               "name a column that the header row contains"});
}

struct ForceColumns {
    std::optional<CsvColumn> normal;
    std::vector<CsvColumn> tangential;
};

ForceColumns forceColumns(const protocols::CsvTable& table, const FrictionOptions& options)
{
    ForceColumns found;
    found.normal = options.normal ? columnOf(table, *options.normal, options) : forceFor(table, normalRole, options);
    for (const ForceAxis& axis : options.tangential) found.tangential.push_back(columnOf(table, axis, options));
    if (!found.tangential.empty()) return found;
    const auto tangential = forceFor(table, tangentialRole, options);
    const auto x = forceFor(table, xRole, options), y = forceFor(table, yRole, options);
    if (tangential && (x || y))
        throw protocols::badInput(
            {"both \"" + tangential->name + "\" and \"" + (x ? x : y)->name + "\" could be the tangential force", table.where,
             "only one of them", "name the axes with --tangential"});
    for (const auto& column : {tangential, x, y})
        if (column) found.tangential.push_back(*column);
    return found;
}

double secondsOf(const std::string& header, const std::string& where)
{
    const std::string unit = nameAndUnit(header).unit;
    for (const auto& [name, seconds] : {std::pair("", 1.0), std::pair("s", 1.0), std::pair("sec", 1.0), std::pair("seconds", 1.0),
                                        std::pair("ms", 1e-3), std::pair("us", 1e-6)})
        if (unit == name) return seconds;
    throw protocols::badInput(
        {"the unit of the column \"" + header + "\" is unknown", where, "s, ms or us", "rename the column"});
}

/// Speed in a file name such as "Denim_F150_V-10mmps_0"; the sign is the direction.
std::optional<double> speedInName(const std::string& stem)
{
    const auto end = stem.find("mmps");
    const auto start = end == std::string::npos ? end : stem.rfind("_V", end);
    if (start == std::string::npos) return std::nullopt;
    const auto speed = protocols::numberIn(stem.substr(start + 2, end - start - 2));
    return speed && *speed != 0 ? std::optional(std::abs(*speed)) : std::nullopt;
}

std::string joined(const std::vector<std::string>& names)
{
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
    return text;
}

}  // namespace

std::vector<RawRecord> readFrictionCsv(const std::filesystem::path& file, const FrictionOptions& options)
{
    const protocols::ForeignTable foreign = protocols::readForeignTable(file);
    const protocols::CsvTable& table = foreign.table;
    const auto time = placeFor(table, timeRole), coefficient = placeFor(table, coefficientRole);
    const ForceColumns forces = forceColumns(table, options);
    const bool both = forces.normal && !forces.tangential.empty();
    if (!time || (!both && !coefficient))
        throw protocols::badInput({"has the columns " + joined(table.columns), table.where,
                                   "columns for time, normal and tangential force (or time and mu)",
                                   "rename the columns, or name them with --normal and --tangential"});
    const double seconds = secondsOf(table.columns[*time], table.where);
    RawRecord record{.where = file.string(), .instrument = "friction-csv"};
    if (!foreign.isUsual) record.form = foreign.taken;
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
        record.timeS.push_back(seconds * numberAt(table, row, *time));
        if (!both) {
            record.values.push_back(numberAt(table, row, *coefficient));
            continue;
        }
        record.normalN.push_back(forces.normal->factor * numberAt(table, row, forces.normal->index));
        record.values.push_back(forces.tangential[0].factor * numberAt(table, row, forces.tangential[0].index));
        if (forces.tangential.size() == 2)
            record.secondTangentialN.push_back(forces.tangential[1].factor * numberAt(table, row, forces.tangential[1].index));
    }
    std::vector<std::string> names;
    for (const CsvColumn& column : forces.tangential) names.push_back(readable(column.name));
    record.meaning = both ? meaningOf(names, readable(forces.normal->name)) : "coefficient of friction";
    return {record};
}

std::vector<RawRecord> readSlide(const std::filesystem::path& file, const FrictionOptions&)
{
    const std::string bytes = protocols::readWholeFile(file);
    protocols::CsvReader reader(bytes, file.string());
    const auto stamp = reader.column("timestamp");
    std::vector<std::size_t> taxels;
    for (std::size_t i = 0; i < reader.columns().size(); ++i)
        if (reader.columns()[i].starts_with("channel")) taxels.push_back(i);
    if (!stamp || taxels.empty())
        throw protocols::badInput(
            {"is not a sliding record", reader.where(), "the columns timestamp, channel1, channel2 and so on", "check the file"});
    RawRecord record{.where = file.string(), .instrument = "slide", .quantity = "taxel_sum_counts"};
    record.meaning = "taxel_sum_counts (sum of " + std::to_string(taxels.size()) + " taxels in counts)";
    while (reader.next()) {
        record.timeS.push_back(1e-3 * reader.number(*stamp));
        double sum = 0;
        for (const std::size_t taxel : taxels) sum += reader.number(taxel);
        record.values.push_back(sum);
    }
    record.speedMmPerS = speedInName(file.stem().string());
    return {record};
}

}  // namespace rendering::fabrics
