// Comma-separated friction records: forces over time under common names, and the sliding finger's
// taxel counts.
#include <algorithm>
#include <charconv>
#include <cmath>

#include "protocols/files/csv_table.h"
#include "protocols/files/number_text.h"
#include "protocols/files/errors.h"
#include "protocols/files/whole_file.h"
#include "rendering/fabrics/recordings/import_kinds.h"
#include "rendering/fabrics/recordings/import_sources.h"

namespace rendering::fabrics {

namespace {

struct Role {
    std::vector<std::string_view> names;
    const char* what;
};

const Role timeRole{{"t", "time", "timestamp", "time_stamp", "zeit", "elapsed_time", "step_time"}, "time"};
const Role normalRole{{"normal", "normal_force", "fn", "f_n", "force_normal", "load", "normal_load", "fz", "f_z", "n"},
                      "normal force"};
const Role tangentialRole{{"tangential", "tangential_force", "ft", "f_t", "friction", "friction_force", "lateral_force",
                           "shear_force", "force_tangential"},
                          "tangential force"};
const Role xRole{{"fx", "f_x", "force_x"}, "force along x"};
const Role yRole{{"fy", "f_y", "force_y"}, "force along y"};
const Role coefficientRole{{"mu", "cof", "coefficient", "friction_coefficient", "coefficient_of_friction"}, "coefficient"};

/// A column and the factor to s or N.
struct Column {
    std::size_t index;
    double factor = 1;
    std::string name = {};
};

/// The column that plays a role; throws badInput where two could.
std::optional<std::size_t> placeFor(const protocols::CsvReader& reader, const Role& role)
{
    std::optional<std::size_t> found;
    for (std::size_t i = 0; i < reader.columns().size(); ++i) {
        const std::string name = takenApart(reader.columns()[i]).name;
        if (std::find(role.names.begin(), role.names.end(), name) == role.names.end()) continue;
        if (found)
            throw protocols::badInput(
                {"both \"" + reader.columns()[*found] + "\" and \"" + reader.columns()[i] + "\" could be the " + role.what,
                 reader.where(), "one column each for time, normal and tangential force",
                 "name the axes with --normal and --tangential"});
        found = i;
    }
    return found;
}

std::optional<Column> forceFor(const protocols::CsvReader& reader, const Role& role, const FrictionOptions& options)
{
    const auto place = placeFor(reader, role);
    if (!place) return std::nullopt;
    const std::string& name = reader.columns()[*place];
    return Column{*place, newtonsOf(name, options, reader.where()), name};
}

/// The column of an axis that the user named, as it stands in the header or without its unit.
Column columnOf(const protocols::CsvReader& reader, const Axis& axis, const FrictionOptions& options)
{
    const std::string wanted = lowerCase(axis.column);
    for (std::size_t i = 0; i < reader.columns().size(); ++i) {
        const std::string& name = reader.columns()[i];
        if (lowerCase(name) != wanted && takenApart(name).name != wanted) continue;
        return {i, axis.sign * newtonsOf(name, options, reader.where()), name};
    }
    throw protocols::badInput({"has no column \"" + axis.column + "\"", reader.where(), "", "see the names in its header"});
}

struct ForceColumns {
    std::optional<Column> normal;
    std::vector<Column> tangential;
};

ForceColumns forceColumns(const protocols::CsvReader& reader, const FrictionOptions& options)
{
    ForceColumns found;
    found.normal = options.normal ? columnOf(reader, *options.normal, options) : forceFor(reader, normalRole, options);
    for (const Axis& axis : options.tangential) found.tangential.push_back(columnOf(reader, axis, options));
    if (!found.tangential.empty()) return found;
    const auto tangential = forceFor(reader, tangentialRole, options);
    const auto x = forceFor(reader, xRole, options), y = forceFor(reader, yRole, options);
    if (tangential && (x || y))
        throw protocols::badInput(
            {"both \"" + tangential->name + "\" and \"" + (x ? x : y)->name + "\" could be the tangential force", reader.where(),
             "one of them", "name the axes with --tangential"});
    for (const auto& column : {tangential, x, y})
        if (column) found.tangential.push_back(*column);
    return found;
}

double secondsOf(const std::string& header, const std::string& where)
{
    const std::string unit = takenApart(header).unit;
    for (const auto& [name, seconds] : {std::pair("", 1.0), std::pair("s", 1.0), std::pair("sec", 1.0), std::pair("seconds", 1.0),
                                        std::pair("ms", 1e-3), std::pair("us", 1e-6)})
        if (unit == name) return seconds;
    throw protocols::badInput({"the unit of the column \"" + header + "\" is not known", where, "s, ms or us", ""});
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
        for (const std::string_view unit : {"s", "sec", "seconds", "ms", "us", "n", "mn", "un", "kn", "g", "gf", "kg", "kgf"})
            if (text.substr(last + 1) == unit) return {text.substr(0, last), std::string(unit)};
    return {text, ""};
}

double newtonsOf(const std::string& header, const FrictionOptions& options, const std::string& where)
{
    const std::string stated = takenApart(header).unit, unit = stated.empty() ? options.forceUnit : stated;
    if (unit.empty()) return 1;
    if (const auto newtons = newtonsIn(unit)) return *newtons;
    throw protocols::badInput(
        {"the unit of the column \"" + header + "\" is not known", where, std::string(knownForceUnits), ""});
}

std::string meaningOf(const std::vector<std::string>& tangential, const std::string& normal)
{
    const std::string force =
        tangential.size() == 2 ? "sqrt(" + tangential[0] + "^2 + " + tangential[1] + "^2)" : tangential.at(0);
    return "coefficient of friction = " + force + " / " + normal;
}

std::vector<RawRecord> readFrictionCsv(const std::filesystem::path& file, const FrictionOptions& options)
{
    const std::string bytes = protocols::readWholeFile(file);
    protocols::CsvReader reader(bytes, file.string(), separatorIn(bytes));
    const auto time = placeFor(reader, timeRole), coefficient = placeFor(reader, coefficientRole);
    const ForceColumns forces = forceColumns(reader, options);
    const bool both = forces.normal && !forces.tangential.empty();
    if (!time || (!both && !coefficient))
        throw protocols::badInput({"has the columns " + joined(reader.columns()), reader.where(),
                                   "time, normal and tangential force (or time and mu), named so in the header",
                                   "rename the columns, or name them with --normal and --tangential"});
    const double seconds = secondsOf(reader.columns()[*time], reader.where());
    RawRecord record{.where = file.string(), .instrument = "friction-csv"};
    while (reader.next()) {
        record.timeS.push_back(seconds * reader.number(*time));
        if (!both) {
            record.values.push_back(reader.number(*coefficient));
            continue;
        }
        record.normalN.push_back(forces.normal->factor * reader.number(forces.normal->index));
        record.values.push_back(forces.tangential[0].factor * reader.number(forces.tangential[0].index));
        if (forces.tangential.size() == 2)
            record.secondTangentialN.push_back(forces.tangential[1].factor * reader.number(forces.tangential[1].index));
    }
    std::vector<std::string> names;
    for (const Column& column : forces.tangential) names.push_back(readable(column.name));
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
            {"is no sliding record", reader.where(), "the columns timestamp and channel1, channel2 ...", ""});
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
