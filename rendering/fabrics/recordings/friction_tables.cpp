#include "rendering/fabrics/recordings/friction_tables.h"

#include <algorithm>
#include <cmath>

#include "protocols/files/csv_table.h"
#include "protocols/files/errors.h"
#include "protocols/files/foreign/foreign_table.h"
#include "protocols/files/number_text.h"
#include "protocols/files/whole_file.h"
#include "rendering/fabrics/recordings/column_names.h"
#include "rendering/fabrics/recordings/record_text.h"

namespace rendering::fabrics {

namespace {

/// A quantity and the column names that are recognised for it.
struct ColumnRole {
    std::vector<std::string_view> names;
    const char* what;
    std::string_view onlyAsForce = {};  ///< a further name, which has other meanings: it counts beside a unit of force only
    bool heedsForceUnit = false;        ///< that unit may be --force-unit
};

const ColumnRole timeRole{{"t", "time", "timestamp", "time_stamp", "zeit", "elapsed_time", "step_time"}, "time"};
const ColumnRole normalRole{{"normal", "normal_force", "fn", "f_n", "force_normal", "load", "normal_load", "fz", "f_z"},
                            "normal force",
                            "n"};  // Without a unit it is usually the number of the sample.
const ColumnRole tangentialRole{
    {"tangential", "tangential_force", "ft", "f_t", "friction_force", "lateral_force", "shear_force", "force_tangential"},
    "tangential force",
    "friction",  // Without a unit it is as often a coefficient.
    true};
const ColumnRole xRole{{"fx", "f_x", "force_x"}, "force along x"};
const ColumnRole yRole{{"fy", "f_y", "force_y"}, "force along y"};
const ColumnRole coefficientRole{{"mu", "cof", "coefficient", "friction_coefficient", "coefficient_of_friction"}, "coefficient"};

/// Column with the factor that converts it to s or N.
struct CsvColumn {
    std::size_t index;
    double factor = 1;
    std::string name = {};
};

bool isIn(const ColumnRole& role, const std::string& header, const FrictionOptions& options)
{
    const auto [name, unit] = nameAndUnit(header);
    return std::find(role.names.begin(), role.names.end(), name) != role.names.end() ||
           (!role.onlyAsForce.empty() && name == role.onlyAsForce &&
            newtonsIn(unit.empty() && role.heedsForceUnit ? options.forceUnit : unit));
}

/// Column of a role. Throws badInput where two columns fit.
std::optional<std::size_t> placeFor(const protocols::CsvTable& table, const ColumnRole& role, const FrictionOptions& options)
{
    std::optional<std::size_t> found;
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
        if (!isIn(role, table.columns[i], options)) continue;
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
    const auto place = placeFor(table, role, options);
    if (!place) return std::nullopt;
    const std::string& name = table.columns[*place];
    return CsvColumn{*place, newtonsOf(name, options, table.where), name};
}

/// Column of an axis that the user named, with or without its unit.
CsvColumn columnOf(const protocols::CsvTable& table, const ForceAxis& axis, const FrictionOptions& options)
{
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
        const std::string& name = table.columns[i];
        if (!isCalled(name, axis.column)) continue;
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
                                        std::pair("ms", 1e-3), std::pair("us", 1e-6), std::pair("ns", 1e-9)})
        if (unit == name) return seconds;
    throw protocols::badInput(
        {"the unit of the column \"" + header + "\" is unknown", where, "s, ms, us or ns", "rename the column"});
}

/// Refuses a column "friction" that may be a force or a coefficient where nothing else says what it is.
void requireKnownFriction(const protocols::CsvTable& table, const FrictionOptions& options)
{
    for (const std::string& column : table.columns)
        if (nameAndUnit(column).name == tangentialRole.onlyAsForce && !isIn(tangentialRole, column, options))
            throw protocols::badInput({"the column \"" + column + "\" may be a force or a coefficient", table.where,
                                       "a force with its unit, or a coefficient called mu",
                                       "rename the column to friction_N or mu, or state --tangential or --force-unit"});
}

/// A coefficient in the file is divided by this number. Throws badInput for a unit of force.
double divisorOf(const std::string& header, const std::string& where)
{
    const std::string unit = nameAndUnit(header).unit;
    if (unit == "%") return 100;
    // Labs write [-], (dimensionless), [N/N] and more; and mu_s is the static coefficient, not one in seconds.
    if (header.find_first_of("([") == std::string::npos || !newtonsIn(unit)) return 1;
    throw protocols::badInput({"the column \"" + header + "\" has a unit that no coefficient has", where,
                               "no unit, (-), (1) or (%)",
                               "rename the column, or name the forces with --normal and --tangential"});
}

bool isTaxel(std::string_view column)
{
    constexpr std::string_view prefix = "channel";
    return column.size() > prefix.size() && column.starts_with(prefix) &&
           column.find_first_not_of("0123456789", prefix.size()) == std::string_view::npos;
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
    const auto time = placeFor(table, timeRole, options), coefficient = placeFor(table, coefficientRole, options);
    const ForceColumns forces = forceColumns(table, options);
    const bool both = forces.normal && !forces.tangential.empty();
    if (time && !coefficient && forces.tangential.empty()) requireKnownFriction(table, options);
    if (!time || (!both && !coefficient))
        throw protocols::badInput({"has the columns " + joined(table.columns), table.where,
                                   "columns for time, normal and tangential force (or time and mu)",
                                   "rename the columns, or name them with --normal and --tangential"});
    const double seconds = secondsOf(table.columns[*time], table.where);
    const double divisor = both ? 1 : divisorOf(table.columns[*coefficient], table.where);
    RawRecord record{.where = file.string(), .instrument = "friction-csv"};
    if (nameAndUnit(table.columns[*time]).unit.empty()) record.timeWithoutUnit = readable(table.columns[*time]);
    if (!foreign.isUsual) record.form = foreign.taken;
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
        record.timeS.push_back(seconds * numberAt(table, row, *time));
        if (!both) {
            record.values.push_back(numberAt(table, row, *coefficient) / divisor);
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
    if (divisor != 1) record.meaning += " = " + readable(table.columns[*coefficient]) + " / 100";
    return {record};
}

std::vector<RawRecord> readSlide(const std::filesystem::path& file, const FrictionOptions&)
{
    const std::string bytes = protocols::readWholeFile(file);
    protocols::CsvReader reader(bytes, file.string());
    const auto stamp = reader.column("timestamp");
    std::vector<std::size_t> taxels;
    for (std::size_t i = 0; i < reader.columns().size(); ++i)
        if (isTaxel(reader.columns()[i])) taxels.push_back(i);
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
