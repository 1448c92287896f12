#include "rendering/fabrics/recordings/instrument_texts.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "protocols/files/errors.h"
#include "protocols/files/number_text.h"
#include "protocols/files/utf8.h"
#include "rendering/fabrics/recordings/column_names.h"
#include "rendering/fabrics/recordings/record_text.h"

namespace rendering::fabrics {

namespace {

constexpr double leastDiscMmPerS = 1e-3;  ///< a disc that holds still has a speed of noise

std::optional<std::size_t> columnNamed(const LineCells& header, std::string_view name)
{
    const auto found = std::find(header.begin(), header.end(), name);
    return found == header.end() ? std::nullopt : std::optional(std::size_t(found - header.begin()));
}

/// "Pin Load (N)" without its unit.
std::string withoutUnit(const std::string& header) { return header.substr(0, header.find(" (")); }

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
        if (std::abs(mean) >= leastDiscMmPerS && std::isfinite(mean)) {
            record.speedMmPerS = std::abs(mean);
            record.speedsMmPerS = discSpeed;
        }
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

}  // namespace rendering::fabrics
