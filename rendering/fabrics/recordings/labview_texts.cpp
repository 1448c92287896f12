#include "rendering/fabrics/recordings/labview_texts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "protocols/files/errors.h"
#include "protocols/files/number_text.h"
#include "protocols/files/utf8.h"
#include "rendering/fabrics/recordings/column_names.h"
#include "rendering/fabrics/recordings/record_text.h"

namespace rendering::fabrics {

namespace {

bool isBlank(std::string_view cell) { return protocols::withoutBlanks(cell).empty(); }

/// Column of a LabVIEW table with the factor that converts it to newtons.
struct LabviewColumn {
    std::size_t index = 0;
    double factor = 1;
    std::string name;
};

/// Part of a LabVIEW file between two headers.
struct LabviewSegment {
    double deltaX = 0;
    bool isOneStep = true;    ///< every column that states Delta_X states the same
    bool lacksTimes = false;  ///< the header says "X_Columns No", so that the cells of the times are blank
    bool decimalComma = false;
    LineCells units = {};  ///< the row Y_Unit_Label of the header
    LabviewColumn time, normal;
    std::vector<LabviewColumn> tangential;
    std::vector<double> timeS, normalN;
    std::vector<std::vector<double>> tangentialN;  ///< one vector for each axis
};

/// The unit that the header gives for a column; empty where it gives none.
std::string unitLabelOf(const LineCells& units, const LineCells& cells, std::size_t column)
{
    std::size_t times = 0;  // columns of times left of the column
    bool hasGaps = true;    // so that the units stand above their own columns
    for (std::size_t i = 1; i < std::min(units.size(), cells.size()); ++i) {
        if (cells[i] != "X_Value") continue;
        if (i < column) ++times;
        if (!isBlank(units[i])) hasGaps = false;
    }
    const std::size_t place = hasGaps ? column : column - times;
    return place > 0 && place < units.size() ? std::string(protocols::withoutBlanks(units[place])) : "";
}

/// Newtons per unit of a column: the unit in its name, else the one in the options, else the one that the header gives.
double labviewNewtons(const std::string& name, const std::string& label, const FrictionOptions& options, const std::string& place)
{
    if (label.empty() || !options.forceUnit.empty() || !nameAndUnit(name).unit.empty()) return newtonsOf(name, options, place);
    if (const auto newtons = newtonsIn(label)) return *newtons;
    throw protocols::badInput({"the unit \"" + protocols::inShort(label, longestCellShown) + "\" of the column \"" +
                                   protocols::inShort(name, longestCellShown) + "\" is unknown",
                               place + ", Y_Unit_Label", std::string(knownForceUnits), "state the unit with --force-unit"});
}

LabviewColumn labviewColumn(const LineCells& cells, const LabviewSegment& pending, const ForceAxis& axis,
                            const FrictionOptions& options, const std::string& place)
{
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const std::string cell(cells[i]);
        if (!isCalled(cell, axis.column)) continue;
        const std::string label = unitLabelOf(pending.units, cells, i);
        return {i, axis.sign * labviewNewtons(cell, label, options, place), nameAndUnit(cell).name};
    }
    throw protocols::badInput({"has no column " + axis.column, place, "the columns X_Value, fx, fy and fz",
                               "name the axes with --normal and --tangential"});
}

LabviewSegment segmentFrom(const LabviewSegment& pending, const LineCells& cells, const FrictionOptions& options,
                           const std::string& place)
{
    LabviewSegment segment;
    segment.deltaX = pending.deltaX;
    segment.isOneStep = pending.isOneStep;
    segment.lacksTimes = pending.lacksTimes;
    segment.decimalComma = pending.decimalComma;
    segment.time = {0, 1, "X_Value"};
    segment.normal = labviewColumn(cells, pending, options.normal.value_or(ForceAxis{"fz"}), options, place);
    const std::vector<ForceAxis> tangential =
        options.tangential.empty() ? std::vector<ForceAxis>{{"fx"}, {"fy"}} : options.tangential;
    for (const ForceAxis& axis : tangential) segment.tangential.push_back(labviewColumn(cells, pending, axis, options, place));
    segment.tangentialN.resize(tangential.size());
    return segment;
}

bool isBlankRow(const LineCells& cells) { return std::all_of(cells.begin(), cells.end(), isBlank); }

void takeStep(LabviewSegment& pending, const LineCells& cells)
{
    pending.deltaX = numberOf(cells[1], pending.decimalComma).value_or(0);
    pending.isOneStep = std::all_of(cells.begin() + 1, cells.end(), [&](auto cell) {
        return isBlank(cell) || numberOf(cell, pending.decimalComma).value_or(0) == pending.deltaX;
    });
}

/// Whether a line that stands in no table has numbers like a row of one.
bool looksLikeRow(const LineCells& cells, const LabviewSegment& pending)
{
    const auto isNumber = [&](auto cell) { return numberOf(cell, pending.decimalComma).has_value(); };
    if (cells.size() < 2) return false;
    return isNumber(cells[0]) ||
           (pending.lacksTimes && isBlank(cells[0]) && std::any_of(cells.begin() + 1, cells.end(), isNumber));
}

/// The next time of a segment without times.
double timeOfRow(const LabviewSegment& segment, const LineCells& cells, const std::string& place)
{
    if (!isBlank(cells[0]))
        throw protocols::badInput({"a time stands below rows without one", place + ", column X_Value",
                                   "times in every row, or in none where X_Columns is No", "correct the row or remove it"});
    if (!(segment.deltaX > 0) || !segment.isOneStep)
        throw protocols::badInput({"has neither times nor one step between its rows", place,
                                   "the same Delta_X above 0 for all columns where X_Columns is No",
                                   "export the file with its X values"});
    return double(segment.timeS.size()) * segment.deltaX;
}

void addRow(LabviewSegment& segment, const LineCells& cells, const std::string& where, std::size_t line)
{
    const auto number = [&](const LabviewColumn& column) {
        const auto value = column.index < cells.size() ? numberOf(cells[column.index], segment.decimalComma) : std::nullopt;
        if (!value)
            throw protocols::badInput({"a number is missing or malformed", lineName(where, line) + ", column " + column.name,
                                       "time and forces in every row", "correct the row or remove it"});
        return column.factor * *value;
    };
    if (segment.timeS.empty()) segment.lacksTimes = segment.lacksTimes && isBlank(cells[0]);
    segment.timeS.push_back(segment.lacksTimes ? timeOfRow(segment, cells, lineName(where, line)) : number(segment.time));
    segment.normalN.push_back(number(segment.normal));
    for (std::size_t i = 0; i < segment.tangential.size(); ++i) segment.tangentialN[i].push_back(number(segment.tangential[i]));
}

/// Whether stamps repeat that are those of the step, rounded to their own resolution: the smallest difference between two.
bool isCoarserThan(double step, const std::vector<double>& timeS)
{
    double resolution = std::numeric_limits<double>::infinity();
    bool repeats = false;
    for (std::size_t i = 1; i < timeS.size(); ++i) {
        const double difference = timeS[i] - timeS[i - 1];
        if (difference < 0) return false;
        repeats = repeats || difference == 0;
        if (difference > 0) resolution = std::min(resolution, difference);
    }
    for (std::size_t i = 0; i < timeS.size(); ++i)
        if (std::isfinite(resolution) && !(std::abs(timeS[i] - timeS.front() - double(i) * step) < resolution)) return false;
    return repeats;
}

RawRecord labviewRecord(LabviewSegment segment, const std::string& where)
{
    RawRecord record{.where = where, .instrument = "labview"};
    std::vector<std::string> names;
    for (const auto& column : segment.tangential) names.push_back(column.name);
    record.meaning = meaningOf(names, segment.normal.name);
    // Some programs write the same stamp into every row, or few decimals, and state the step in the header.
    if (isCoarserThan(segment.deltaX, segment.timeS))
        for (std::size_t i = 0; i < segment.timeS.size(); ++i) segment.timeS[i] = double(i) * segment.deltaX;
    record.timeS = std::move(segment.timeS);
    record.normalN = std::move(segment.normalN);
    record.values = std::move(segment.tangentialN.at(0));
    if (segment.tangentialN.size() == 2) record.secondTangentialN = std::move(segment.tangentialN[1]);
    return record;
}

/// The header says which sign separates the cells, also its own. Throws badInput where it cannot be told from decimal commas.
char labviewSeparator(const std::vector<std::string_view>& lines, const std::string& where)
{
    constexpr std::string_view separator = "Separator,Comma", decimalComma = "Decimal_Separator,,";
    const auto end = std::find_if(lines.begin(), lines.end(), [](auto line) { return line.starts_with("***End_of_Header***"); });
    const auto says = [&](std::string_view words) {
        return std::any_of(lines.begin(), end, [&](auto line) { return line.starts_with(words); });
    };
    if (!says(separator)) return '\t';
    if (says(decimalComma))
        throw protocols::badInput(
            {"has commas between its cells and in its numbers", where, "tabs, or decimal points", "export the file with tabs"});
    return ',';
}

}  // namespace

std::vector<RawRecord> readLabview(const std::filesystem::path& file, const FrictionOptions& options)
{
    const std::string text = recordText(file);
    const std::vector<std::string_view> lines = linesOf(text);
    if (lines.empty() || !lines.front().starts_with("LabVIEW Measurement"))
        throw protocols::badInput({"is not a LabVIEW measurement file", file.string(),
                                   "\"LabVIEW Measurement\" in its first line", "check the kind of import"});
    const char separator = labviewSeparator(lines, file.string());
    std::vector<LabviewSegment> segments;
    LabviewSegment pending;
    bool inRows = false;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const LineCells cells = splitAt(lines[i], separator);
        if (cells[0].starts_with("Decimal_Separator"))
            pending.decimalComma = separator != ',' && lines[i].find(',') != std::string::npos;
        else if (cells[0] == "X_Columns" && cells.size() > 1)
            pending.lacksTimes = protocols::withoutBlanks(cells[1]) == "No";
        else if (cells[0] == "Y_Unit_Label")
            pending.units = cells;
        else if (cells[0] == "Delta_X" && cells.size() > 1)
            takeStep(pending, cells);
        else if (cells[0] == "X_Value") {
            segments.push_back(segmentFrom(pending, cells, options, lineName(file.string(), i)));
            requireFewTables(segments.size(), file.string());
            inRows = true;
        } else if (inRows && (isBlankRow(cells) || cells[0] == "Channels")) {
            inRows = false;
        } else if (inRows) {
            addRow(segments.back(), cells, file.string(), i);
        } else if (!segments.empty() && looksLikeRow(cells, pending)) {
            throw rowOutsideTable(file.string(), i);
        }
    }
    if (segments.empty())
        throw protocols::badInput(
            {"has no table", file.string(), "a header row that begins with X_Value", "check that the file is complete"});
    std::vector<RawRecord> records;
    for (std::size_t i = 0; i < segments.size(); ++i)
        records.push_back(labviewRecord(std::move(segments[i]), file.string() + ", segment " + std::to_string(i + 1)));
    return records;
}

}  // namespace rendering::fabrics
