// Text files of two instruments: the PCS (MTM) tribometer and LabVIEW measurement files with forces.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "protocols/errors.h"
#include "rendering/fabrics/csv_table.h"
#include "rendering/fabrics/import_kinds.h"
#include "rendering/whole_file.h"

namespace rendering::fabrics {

namespace {

using Cells = std::vector<std::string_view>;

std::optional<std::size_t> columnNamed(const Cells& header, std::string_view name)
{
    const auto found = std::find(header.begin(), header.end(), name);
    return found == header.end() ? std::nullopt : std::optional(std::size_t(found - header.begin()));
}

std::string lineName(const std::string& where, std::size_t line) { return where + ", line " + std::to_string(line + 1); }

/// One step of a tribometer profile, its wanted columns as text.
class StepTable {
public:
    StepTable(const std::string& where, std::string_view header)
        : m_where(where), m_header(header), m_columns(splitAt(m_header, '\t'))
    {
    }

    void addLine(std::string_view line, std::size_t number)
    {
        m_lines.emplace_back(line);
        m_numbers.push_back(number);
    }
    std::size_t rows() const { return m_lines.size(); }

    /// Empty where the column is missing or has no number in any row. Throws badInput for text and for gaps.
    std::vector<double> column(std::string_view name) const
    {
        const auto at = columnNamed(m_columns, name);
        if (!at) return {};
        std::vector<double> values;
        for (std::size_t row = 0; row < m_lines.size(); ++row) {
            const Cells cells = splitAt(m_lines[row], '\t');
            const std::string_view cell = *at < cells.size() ? cells[*at] : std::string_view();
            if (cell.empty() && values.size() == 0) continue;
            const auto value = numberIn(cell);
            if (!value || values.size() != row)
                throw protocols::badInput({"\"" + std::string(cell) + "\" is no number",
                                           lineName(m_where, m_numbers[row]) + ", column " + std::string(name),
                                           "a number in every row", ""});
            values.push_back(*value);
        }
        return values;
    }

private:
    std::string m_where;
    std::string m_header;
    Cells m_columns;
    std::vector<std::string> m_lines;
    std::vector<std::size_t> m_numbers;
};

RawRecord tribometerRecord(const StepTable& step, const std::string& where)
{
    RawRecord record;
    record.where = where;
    record.instrument = "tribometer";
    record.timeS = step.column("Step Time (s)");
    const std::vector<double> force = step.column("Traction Force (N)");
    const std::vector<double> pin = step.column("Pin Load (N)"), ball = step.column("Ball Load (N)");
    const std::vector<double>& load = pin.empty() ? ball : pin;
    if (!force.empty() && !load.empty()) {
        for (std::size_t row = 0; row < force.size(); ++row) {
            if (load[row] <= 0.05)
                throw protocols::badInput({"the load is " + shortest(load[row]) + " N",
                                           where + ", row " + std::to_string(row + 1), "more than 0.05 N",
                                           "cut the record to the contact"});
            record.values.push_back(force[row] / load[row]);
        }
        record.meaning = std::string("coefficient of friction = Traction Force / ") + (pin.empty() ? "Ball" : "Pin") + " Load";
    } else {
        record.values = step.column("Traction Coeff (-)");
        record.meaning = "coefficient of friction as the instrument gives it";
    }
    if (record.timeS.empty() || record.values.empty())
        throw protocols::badInput({"has no time or no coefficient", where,
                                   "the columns Step Time, Traction Force and Pin Load, or Traction Coeff", ""});
    const std::vector<double> speed = step.column("Sliding Speed (mm/s)");
    const std::vector<double> discSpeed = speed.empty() ? step.column("Disc Speed 1") : speed;
    if (!discSpeed.empty()) {
        const double mean = std::accumulate(discSpeed.begin(), discSpeed.end(), 0.0) / double(discSpeed.size());
        if (mean != 0) record.speedMmPerS = std::abs(mean);
    }
    return record;
}

/// The part of a LabVIEW file between two headers.
struct Segment {
    double deltaX = 0;
    bool decimalComma = false;
    std::vector<std::size_t> columns;  ///< X_Value, fx, fy, fz
    std::vector<std::vector<double>> rows;
};

std::optional<std::vector<std::size_t>> forceColumns(const Cells& cells)
{
    std::vector<std::size_t> columns;
    const auto x = columnNamed(cells, "X_Value");
    if (!x) return std::nullopt;
    columns.push_back(*x);
    for (const std::string_view name : {"fx", "fy", "fz"}) {
        const auto found = std::find_if(cells.begin(), cells.end(), [&](std::string_view cell) {
            return cell == name ||
                   (cell.starts_with(name) && cell.size() > 2 && (cell[2] == '_' || cell[2] == ' ' || cell[2] == '('));
        });
        if (found == cells.end()) return std::nullopt;
        columns.push_back(std::size_t(found - cells.begin()));
    }
    return columns;
}

std::optional<double> labviewNumber(std::string_view cell, bool decimalComma)
{
    std::string text(cell);
    if (decimalComma) std::replace(text.begin(), text.end(), ',', '.');
    return numberIn(text);
}

void addRow(Segment& segment, const Cells& cells, const std::string& place)
{
    std::vector<double> row;
    for (const std::size_t column : segment.columns) {
        const auto value = column < cells.size() ? labviewNumber(cells[column], segment.decimalComma) : std::nullopt;
        if (!value)
            throw protocols::badInput({"a number is missing or malformed", place, "X_Value, fx, fy and fz in every row", ""});
        row.push_back(*value);
    }
    segment.rows.push_back(std::move(row));
}

RawRecord labviewRecord(const Segment& segment, const std::string& where)
{
    RawRecord record;
    record.where = where;
    record.instrument = "labview";
    record.meaning = "coefficient of friction = sqrt(fx^2 + fy^2) / |fz|";
    const bool stamped = segment.rows.size() < 2 || segment.rows[1][0] > segment.rows[0][0];
    for (std::size_t i = 0; i < segment.rows.size(); ++i) {
        const std::vector<double>& row = segment.rows[i];
        record.timeS.push_back(stamped ? row[0] : double(i) * segment.deltaX);
        record.values.push_back(std::hypot(row[1], row[2]));
        record.normalN.push_back(std::abs(row[3]));
    }
    return record;
}

}  // namespace

std::vector<std::string> linesOfText(std::string_view bytes)
{
    std::vector<std::string> lines;
    while (!bytes.empty()) {
        const auto end = std::min(bytes.find('\n'), bytes.size());
        std::string line;
        for (const char c : bytes.substr(0, end)) {
            const auto byte = static_cast<unsigned char>(c);
            if (byte >= 0x80) {
                line += char(0xC0 | (byte >> 6));
                line += char(0x80 | (byte & 0x3F));
            } else if (c != '\r') {
                line += c;
            }
        }
        lines.push_back(std::move(line));
        bytes.remove_prefix(std::min(end + 1, bytes.size()));
    }
    return lines;
}

std::vector<std::string_view> splitAt(std::string_view line, char separator)
{
    std::vector<std::string_view> cells;
    while (true) {
        const auto at = line.find(separator);
        cells.push_back(line.substr(0, at));
        if (at == std::string_view::npos) return cells;
        line.remove_prefix(at + 1);
    }
}

std::vector<RawRecord> readTribometer(const std::filesystem::path& file)
{
    const std::vector<std::string> lines = linesOfText(readWholeFile(file));
    std::vector<StepTable> steps;
    bool inTable = false;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const std::string& line = lines[i];
        const std::string_view first = std::string_view(line).substr(0, line.find('\t'));
        if (first == "Step Time (s)") {
            steps.emplace_back(file.string(), line);
            inTable = true;
        } else if (inTable && numberIn(first)) {
            steps.back().addLine(line, i);
        } else if (inTable && line.find('\t') != std::string::npos && !first.starts_with("Step")) {
            throw protocols::badInput(
                {"\"" + std::string(first) + "\" is no time", lineName(file.string(), i), "a number of seconds", ""});
        } else {
            inTable = false;
        }
    }
    if (steps.empty())
        throw protocols::badInput(
            {"is no tribometer file", file.string(), "a table that begins with the column Step Time (s)", ""});
    std::vector<RawRecord> records;
    for (std::size_t i = 0; i < steps.size(); ++i)
        records.push_back(
            tribometerRecord(steps[i], file.string() + (steps.size() > 1 ? ", step " + std::to_string(i + 1) : "")));
    return records;
}

std::vector<RawRecord> readLabview(const std::filesystem::path& file)
{
    const std::vector<std::string> lines = linesOfText(readWholeFile(file));
    if (lines.empty() || !lines.front().starts_with("LabVIEW Measurement"))
        throw protocols::badInput(
            {"is no LabVIEW measurement file", file.string(), "\"LabVIEW Measurement\" in its first line", ""});
    std::vector<Segment> segments;
    Segment pending;
    bool inRows = false;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const Cells cells = splitAt(lines[i], '\t');
        if (cells[0].starts_with("Decimal_Separator"))
            pending.decimalComma = lines[i].find(',') != std::string::npos;
        else if (cells[0] == "Delta_X" && cells.size() > 1)
            pending.deltaX = labviewNumber(cells[1], pending.decimalComma).value_or(0);
        else if (cells[0] == "X_Value") {
            const auto columns = forceColumns(cells);
            if (!columns)
                throw protocols::badInput(
                    {"has no forces", lineName(file.string(), i), "the columns X_Value, fx, fy and fz", ""});
            segments.push_back(pending);
            segments.back().columns = *columns;
            inRows = true;
        } else if (inRows && (cells[0].empty() || cells[0] == "Channels")) {
            inRows = false;
        } else if (inRows) {
            addRow(segments.back(), cells, lineName(file.string(), i));
        }
    }
    if (segments.empty()) throw protocols::badInput({"has no table", file.string(), "a header row that begins with X_Value", ""});
    std::vector<RawRecord> records;
    for (std::size_t i = 0; i < segments.size(); ++i)
        records.push_back(labviewRecord(segments[i], file.string() + ", segment " + std::to_string(i + 1)));
    return records;
}

}  // namespace rendering::fabrics
