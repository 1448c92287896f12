#include "rendering/fabrics/recordings/instrument_texts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "protocols/files/errors.h"
#include "protocols/files/number_text.h"
#include "protocols/files/utf8.h"
#include "rendering/fabrics/recordings/column_names.h"
#include "rendering/fabrics/recordings/record_text.h"

namespace rendering::fabrics {

namespace {

constexpr double leastDiscMmPerS = 1e-3;  ///< a disc that holds still has a speed of noise

/// Most tables of one file. A table without rows takes some hundred bytes.
constexpr std::size_t mostRecordTables = 10'000;

constexpr std::size_t longestCellShown = 60;  ///< in a message, bytes

using LineCells = std::vector<std::string_view>;

std::optional<std::size_t> columnNamed(const LineCells& header, std::string_view name)
{
    const auto found = std::find(header.begin(), header.end(), name);
    return found == header.end() ? std::nullopt : std::optional(std::size_t(found - header.begin()));
}

std::optional<double> numberOf(std::string_view cell, bool decimalComma)
{
    if (!decimalComma) return protocols::numberIn(cell);
    std::string text(cell);
    std::replace(text.begin(), text.end(), ',', '.');
    return protocols::numberIn(text);
}

bool isBlank(std::string_view cell) { return protocols::withoutBlanks(cell).empty(); }

/// "Pin Load (N)" without its unit.
std::string withoutUnit(const std::string& header) { return header.substr(0, header.find(" (")); }

std::string lineName(const std::string& where, std::size_t line) { return where + ", line " + std::to_string(line + 1); }

void requireFewTables(std::size_t count, const std::string& where)
{
    if (count <= mostRecordTables) return;
    throw protocols::badInput({"has more than " + std::to_string(mostRecordTables) + " tables", where,
                               "at most " + std::to_string(mostRecordTables), "check that the file is a recording, or split it"});
}

/// Table of one step of a tribometer profile, kept as text until a column is read.
class StepTable {
public:
    StepTable(const std::string& where, std::string_view header, bool decimalComma)
        : m_where(where), m_header(header), m_decimalComma(decimalComma)
    {
    }

    void addLine(std::string_view line, std::size_t number)
    {
        m_lines.push_back(line);
        m_numbers.push_back(number);
    }
    std::size_t rows() const { return m_lines.size(); }
    bool hasDecimalCommas() const { return m_decimalComma; }

    /// Header of the column that a user calls `name`; empty where there is none.
    std::string headerCalled(const std::string& name) const
    {
        for (const std::string_view header : splitAt(m_header, '\t'))
            if (isCalled(std::string(header), name)) return std::string(header);
        return "";
    }

    /// Numbers of a column; empty where it is missing or has no number in any row. Throws badInput for text and for gaps.
    std::vector<double> column(std::string_view name) const
    {
        const auto at = columnNamed(splitAt(m_header, '\t'), name);
        if (!at) return {};
        std::vector<double> values;
        for (std::size_t row = 0; row < m_lines.size(); ++row) {
            const LineCells cells = splitAt(m_lines[row], '\t');
            const std::string_view cell = *at < cells.size() ? cells[*at] : std::string_view();
            if (cell.empty() && values.size() == 0) continue;
            const auto value = numberOf(cell, m_decimalComma);
            if (!value || values.size() != row)
                throw protocols::badInput({"\"" + protocols::inShort(cell, longestCellShown) + "\" is not a number",
                                           lineName(m_where, m_numbers[row]) + ", column " + std::string(name),
                                           "a number in every row", "correct the row or remove it"});
            values.push_back(*value);
        }
        return values;
    }

private:
    std::string m_where;
    std::string_view m_header;  ///< split where it is needed: a file may hold thousands of long ones
    bool m_decimalComma;
    std::vector<std::string_view> m_lines;  ///< parts of the file's text, which outlives the table
    std::vector<std::size_t> m_numbers;
};

/// Column of forces in N; `name` is its header.
struct ForceColumn {
    std::string name;
    std::vector<double> values;
};

/// The column that the user named. Throws badInput where it is missing or empty, or has an unknown unit.
ForceColumn namedForce(const StepTable& step, const ForceAxis& axis, const FrictionOptions& options, const std::string& where)
{
    ForceColumn column{step.headerCalled(axis.column), {}};
    if (!column.name.empty()) column.values = step.column(column.name);
    if (column.values.empty())
        throw protocols::badInput(
            {(column.name.empty() ? "has no column \"" : "has no numbers in the column \"") + axis.column + "\"", where,
             "a column of the step's table, with numbers", "name such a column with --normal or --tangential"});
    const double factor = axis.sign * newtonsOf(column.name, options, where);
    for (double& value : column.values) value *= factor;
    return column;
}

/// The first of `names` that has numbers.
ForceColumn usualForce(const StepTable& step, const std::vector<std::string>& names)
{
    for (const std::string& name : names)
        if (ForceColumn column{name, step.column(name)}; !column.values.empty()) return column;
    return {};
}

RawRecord tribometerRecord(const StepTable& step, const std::string& where, const FrictionOptions& options)
{
    if (options.tangential.size() > 1)
        throw protocols::badInput({"--tangential names two axes", where,
                                   "one axis, because this instrument measures one tangential force",
                                   "name one column with --tangential"});
    RawRecord record{.where = where, .instrument = "tribometer"};
    if (step.hasDecimalCommas()) record.form = "decimal commas";
    record.timeS = step.column("Step Time (s)");
    const ForceColumn force = options.tangential.empty() ? usualForce(step, {"Traction Force (N)"})
                                                         : namedForce(step, options.tangential.front(), options, where);
    const ForceColumn load =
        options.normal ? namedForce(step, *options.normal, options, where) : usualForce(step, {"Pin Load (N)", "Ball Load (N)"});
    const bool isNamed = options.normal || !options.tangential.empty();
    if (isNamed && (force.values.empty() || load.values.empty()))
        throw protocols::badInput(
            {"has no " + std::string(load.values.empty() ? "normal" : "tangential") + " force that goes with the named column",
             where, "columns of both forces", "name both with --normal and --tangential"});
    if (!force.values.empty() && !load.values.empty()) {
        record.values = force.values;
        record.normalN = load.values;
        record.meaning = meaningOf({withoutUnit(force.name)}, withoutUnit(load.name));
    } else {
        record.values = step.column("Traction Coeff (-)");
        record.meaning = "coefficient of friction as the instrument gives it";
    }
    const bool uneven =
        record.values.size() != record.timeS.size() || (!record.normalN.empty() && record.normalN.size() != record.timeS.size());
    if (record.timeS.empty() || record.values.empty() || uneven)
        throw protocols::badInput({"has no time or no coefficient", where,
                                   "the columns Step Time, Traction Force and Pin Load, or Traction Coeff",
                                   "export the file with these columns"});
    const std::vector<double> speed = step.column("Sliding Speed (mm/s)");
    const std::vector<double> discSpeed = speed.empty() ? step.column("Disc Speed 1") : speed;
    if (!discSpeed.empty()) {
        const double mean = std::accumulate(discSpeed.begin(), discSpeed.end(), 0.0) / double(discSpeed.size());
        if (std::abs(mean) >= leastDiscMmPerS && std::isfinite(mean)) record.speedMmPerS = std::abs(mean);
    }
    return record;
}

bool isDigitAt(std::string_view text, std::size_t place)
{
    return place < text.size() && text[place] >= '0' && text[place] <= '9';
}

/// Whether the comma of "1,234" may stand between thousands. It stands before decimals in "0,400", "12,5" and "1234,567".
bool mayBeThousands(std::string_view number)
{
    if (number.starts_with('-') || number.starts_with('+')) number.remove_prefix(1);
    const std::size_t comma = number.find(',');
    return comma >= 1 && comma <= 3 && number.front() != '0' && number.size() == comma + 4 && isDigitAt(number, comma + 1) &&
           isDigitAt(number, comma + 2) && isDigitAt(number, comma + 3);
}

/// Whether the numbers below the headers of a tribometer have decimal commas: none has a point, and the comma of at least one
/// cannot stand between thousands.
bool writesDecimalCommas(const std::vector<std::string_view>& lines)
{
    bool inTable = false, hasDecimals = false;
    for (const std::string_view line : lines) {
        const LineCells cells = splitAt(line, '\t');
        const bool isHeader = cells[0] == "Step Time (s)";
        inTable = isHeader || (inTable && numberOf(cells[0], true));
        if (isHeader || !inTable) continue;
        for (const std::string_view padded : cells) {
            const std::string_view cell = protocols::withoutBlanks(padded);
            const std::size_t comma = cell.find(',');
            if (cell.find('.') != std::string_view::npos && protocols::numberIn(cell)) return false;
            if (comma == std::string_view::npos || !isDigitAt(cell, comma + 1) || !numberOf(cell, true)) continue;
            hasDecimals = hasDecimals || !mayBeThousands(cell);
        }
    }
    return hasDecimals;
}

/// Column of a LabVIEW table with the factor that converts it to newtons.
struct LabviewColumn {
    std::size_t index = 0;
    double factor = 1;
    std::string name;
};

/// Part of a LabVIEW file between two headers.
struct Segment {
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

LabviewColumn labviewColumn(const LineCells& cells, const Segment& pending, const ForceAxis& axis, const FrictionOptions& options,
                            const std::string& place)
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

Segment segmentFrom(const Segment& pending, const LineCells& cells, const FrictionOptions& options, const std::string& place)
{
    Segment segment;
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

void takeStep(Segment& pending, const LineCells& cells)
{
    pending.deltaX = numberOf(cells[1], pending.decimalComma).value_or(0);
    pending.isOneStep = std::all_of(cells.begin() + 1, cells.end(), [&](auto cell) {
        return isBlank(cell) || numberOf(cell, pending.decimalComma).value_or(0) == pending.deltaX;
    });
}

/// Whether a line that stands in no table has numbers like a row of one.
bool looksLikeRow(const LineCells& cells, const Segment& pending)
{
    const auto isNumber = [&](auto cell) { return numberOf(cell, pending.decimalComma).has_value(); };
    if (cells.size() < 2) return false;
    return isNumber(cells[0]) ||
           (pending.lacksTimes && isBlank(cells[0]) && std::any_of(cells.begin() + 1, cells.end(), isNumber));
}

/// The next time of a segment without times.
double timeOfRow(const Segment& segment, const LineCells& cells, const std::string& place)
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

void addRow(Segment& segment, const LineCells& cells, const std::string& where, std::size_t line)
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

RawRecord labviewRecord(Segment segment, const std::string& where)
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

protocols::Error rowOutsideTable(const std::string& where, std::size_t line)
{
    return protocols::badInput({"a row of numbers stands after the end of its table", lineName(where, line),
                                "rows of numbers directly below their header or below each other",
                                "remove the lines that interrupt the table, or the row"});
}

}  // namespace

std::vector<RawRecord> readTribometer(const std::filesystem::path& file, const FrictionOptions& options)
{
    const std::string text = recordText(file);
    const std::vector<std::string_view> lines = linesOf(text);
    const bool commas = text.find(',') != std::string::npos && writesDecimalCommas(lines);
    std::vector<StepTable> steps;
    bool inTable = false;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const std::string_view line = lines[i], first = line.substr(0, line.find('\t'));
        if (first == "Step Time (s)") {
            steps.emplace_back(file.string(), line, commas);
            requireFewTables(steps.size(), file.string());
            inTable = true;
        } else if (inTable && numberOf(first, commas)) {
            steps.back().addLine(line, i);
        } else if (inTable && line.find('\t') != std::string_view::npos && !first.starts_with("Step")) {
            throw protocols::badInput({"\"" + protocols::inShort(first, longestCellShown) + "\" is not a time",
                                       lineName(file.string(), i), "a number of seconds", "correct the row"});
        } else if (!steps.empty() && line.find('\t') != std::string_view::npos && numberOf(first, commas)) {
            throw rowOutsideTable(file.string(), i);
        } else {
            inTable = false;
        }
    }
    if (steps.empty())
        throw protocols::badInput({"is not a tribometer file", file.string(), "a table that begins with the column Step Time (s)",
                                   "check the kind of import"});
    std::vector<RawRecord> records;
    for (std::size_t i = 0; i < steps.size(); ++i)
        records.push_back(
            tribometerRecord(steps[i], file.string() + (steps.size() > 1 ? ", step " + std::to_string(i + 1) : ""), options));
    return records;
}

std::vector<RawRecord> readLabview(const std::filesystem::path& file, const FrictionOptions& options)
{
    const std::string text = recordText(file);
    const std::vector<std::string_view> lines = linesOf(text);
    if (lines.empty() || !lines.front().starts_with("LabVIEW Measurement"))
        throw protocols::badInput({"is not a LabVIEW measurement file", file.string(),
                                   "\"LabVIEW Measurement\" in its first line", "check the kind of import"});
    const char separator = labviewSeparator(lines, file.string());
    std::vector<Segment> segments;
    Segment pending;
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
