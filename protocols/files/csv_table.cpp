#include "protocols/files/csv_table.h"

#include <algorithm>
#include <set>

#include "protocols/files/errors.h"
#include "protocols/files/number_text.h"
#include "protocols/files/utf8.h"

namespace protocols {

namespace {

/// Longest name of a column, bytes. Messages list the names.
constexpr std::size_t longestColumnName = 1000;

/// Longest part of a cell in a message, bytes.
constexpr std::size_t longestCellShown = 60;

std::optional<std::size_t> placeOf(const std::vector<std::string>& columns, std::string_view name)
{
    const auto found = std::find(columns.begin(), columns.end(), name);
    return found == columns.end() ? std::nullopt : std::optional(std::size_t(found - columns.begin()));
}

std::string rowText(const std::string& where, std::size_t row, std::size_t line)
{
    return where + ", row " + std::to_string(row) + " (line " + std::to_string(line) + ")";
}

Error notANumber(const std::string& cell, const std::string& row, const std::string& column, const std::string& expected)
{
    return badInput({cell.empty() ? "the cell is empty" : "\"" + inShort(cell, longestCellShown) + "\" is not a number",
                     row + ", column " + column, expected, ""});
}

}  // namespace

CsvReader::CsvReader(std::string_view text, std::string where, char separator)
    : m_text(withoutByteOrderMark(text)),
      m_where(std::move(where)),
      m_separator(separator),
      m_afterContent(m_text.find_last_not_of(" \t\r\n") + 1)
{
    do {
        if (isAtEnd()) throw badInput({"the file is empty", m_where, "a header row", ""});
        readRecord();
    } while (isBlankLine());
    std::set<std::string_view> seen;
    for (const std::string& name : m_cells) m_columns.emplace_back(withoutBlanks(name));
    for (const std::string& name : m_columns)
        if (name.size() > longestColumnName)
            throw badInput({"a column name has " + std::to_string(name.size()) + " bytes", lineName(),
                            "at most " + std::to_string(longestColumnName), "check that the file is a table"});
    for (const std::string& name : m_columns)
        if (!name.empty() && !seen.insert(name).second)
            throw badInput({"the column \"" + name + "\" occurs twice", lineName(), "each column once", ""});
}

std::optional<std::size_t> CsvReader::column(std::string_view name) const { return placeOf(m_columns, name); }

bool CsvReader::next()
{
    do {
        if (isAtEnd()) return false;
        readRecord();
    } while (isNoRow());
    ++m_rows;
    if (m_cells.size() != m_columns.size())
        throw badInput({"the row has " + std::to_string(m_cells.size()) + (m_cells.size() == 1 ? " cell" : " cells"), rowName(),
                        std::to_string(m_columns.size()) + ", as the header has", ""});
    return true;
}

double CsvReader::number(std::size_t column) const
{
    // The name of the row is made only for a fault: this function is called 10^7 times.
    if (const auto value = numberIn(m_cells[column])) return *value;
    throw notANumber(m_cells[column], rowName(), m_columns[column], "a finite number");
}

std::string CsvReader::rowName() const { return rowText(m_where, m_rows, m_line); }

std::string CsvReader::lineName() const { return m_where + ", line " + std::to_string(m_line); }

/// A line break ends a record unless it stands in quotes. "\r\r\n" is one: Python on Windows writes it where a file was opened
/// without newline="".
void CsvReader::readRecord()
{
    m_start = m_at;
    m_line = m_nextLine;
    std::size_t count = 0;
    while (true) {
        if (count == mostColumns)
            throw badInput({"the row has more than " + std::to_string(mostColumns) + " cells", lineName(),
                            "at most " + std::to_string(mostColumns), "check that the file is a table, and its separator"});
        if (m_cells.size() <= count) m_cells.emplace_back();
        readCell(m_cells[count++]);
        if (isAtEnd() || m_text[m_at] != m_separator) break;
        ++m_at;
    }
    m_cells.resize(count);
    if (m_text.substr(m_at).starts_with("\r\r\n")) ++m_at;
    if (!isAtEnd() && m_text[m_at] == '\r') ++m_at;
    if (!isAtEnd() && m_text[m_at] == '\n') ++m_at;
    ++m_nextLine;
}

void CsvReader::readCell(std::string& cell)
{
    if (!isAtEnd() && m_text[m_at] == '"') {
        readQuotedCell(cell);
        return;
    }
    const std::size_t start = m_at;
    for (; !isAtCellEnd(); ++m_at)
        if (m_text[m_at] == '"')
            throw badInput(
                {"a quote stands inside a cell", lineName(), "the whole cell in quotes, with inner quotes doubled", ""});
    cell.assign(m_text.substr(start, m_at - start));
}

void CsvReader::readQuotedCell(std::string& cell)
{
    cell.clear();
    for (++m_at; !isAtEnd(); ++m_at) {
        if (m_text[m_at] != '"') {
            cell += m_text[m_at];
            if (m_text[m_at] == '\n') ++m_nextLine;
        } else if (m_at + 1 < m_text.size() && m_text[m_at + 1] == '"') {
            cell += '"';
            ++m_at;
        } else {
            ++m_at;
            if (!isAtCellEnd())
                throw badInput({"text follows a closing quote", lineName(), "a separator or the end of the line", ""});
            return;
        }
    }
    throw badInput({"a quote is never closed", lineName(), "a closing quote", ""});
}

bool CsvReader::isAtCellEnd() const
{
    return isAtEnd() || m_text[m_at] == m_separator || m_text[m_at] == '\n' || m_text[m_at] == '\r';
}

/// A quoted cell is not blank, whatever it holds.
bool CsvReader::isBlankLine() const
{
    return m_cells.size() == 1 && withoutBlanks(m_text.substr(m_start, m_at - m_start)).empty();
}

/// A blank line of one column is a missing cell; the last ones are only line breaks.
bool CsvReader::isNoRow() const { return isBlankLine() && (m_columns.size() > 1 || m_start >= m_afterContent); }

std::optional<std::size_t> CsvTable::column(std::string_view name) const { return placeOf(columns, name); }

CsvTable csvTableFrom(std::string_view text, const std::string& where, char separator, std::size_t cells)
{
    CsvReader reader(text, where, separator);
    CsvTable table{where, reader.columns(), {}, {}};
    const std::size_t mostRows = cells / (reader.columns().size() + 2);
    while (reader.next()) {
        if (table.rows.size() == mostRows)
            throw badInput({"the table has more than " + std::to_string(mostRows) + " rows of " +
                                std::to_string(reader.columns().size()) + (reader.columns().size() == 1 ? " cell" : " cells"),
                            where, "at most " + std::to_string(cells) + " cells in all, where a row counts as two more",
                            "leave out columns, or split the table"});
        table.rows.push_back(reader.cells());
        table.lines.push_back(reader.line());
    }
    return table;
}

std::string rowName(const CsvTable& table, std::size_t row) { return rowText(table.where, row + 1, table.lines[row]); }

double numberAt(const CsvTable& table, std::size_t row, std::size_t column)
{
    const std::string& cell = table.rows[row][column];
    if (const auto value = numberIn(cell)) return *value;
    throw notANumber(cell, rowName(table, row), table.columns[column], "a finite number");
}

bool isMissing(std::string_view cell)
{
    cell = withoutBlanks(cell);
    return cell.empty() || cell == "NA" || cell == "NaN" || cell == "nan";
}

std::optional<double> numberOrMissing(const CsvTable& table, std::size_t row, std::size_t column)
{
    const std::string& cell = table.rows[row][column];
    if (isMissing(cell)) return std::nullopt;
    if (const auto value = numberIn(cell)) return value;
    throw notANumber(cell, rowName(table, row), table.columns[column],
                     "a finite number; an empty cell, NA or NaN for a missing value");
}

std::string csvCell(std::string_view text, char separator)
{
    const bool needsQuotes =
        std::any_of(text.begin(), text.end(), [&](char c) { return c == separator || c == '"' || c == '\r' || c == '\n'; });
    if (!needsQuotes) return std::string(text);
    std::string quoted = "\"";
    for (const char c : text) {
        if (c == '"') quoted += '"';
        quoted += c;
    }
    return quoted + '"';
}

std::string csvRow(const std::vector<std::string>& cells, char separator)
{
    if (cells.size() == 1 && withoutBlanks(cells.front()).empty()) return '"' + cells.front() + "\"\n";
    std::string row;
    for (const std::string& cell : cells) {
        if (&cell != &cells.front()) row += separator;
        row += csvCell(cell, separator);
    }
    return row + "\n";
}

}  // namespace protocols
