#include "protocols/files/csv_table.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>

#include "protocols/files/errors.h"
#include "protocols/files/whole_file.h"

namespace rendering::fabrics {

namespace {

std::string_view withoutBlanks(std::string_view text)
{
    constexpr std::string_view blanks = " \t\r\n";
    const auto first = text.find_first_not_of(blanks);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

std::optional<std::size_t> placeOf(const std::vector<std::string>& columns, std::string_view name)
{
    const auto found = std::find(columns.begin(), columns.end(), name);
    return found == columns.end() ? std::nullopt : std::optional(std::size_t(found - columns.begin()));
}

double numberOrFault(const std::string& cell, const std::string& row, const std::string& column)
{
    if (const auto value = numberIn(cell)) return *value;
    throw protocols::badInput(
        {cell.empty() ? "is empty" : "\"" + cell + "\" is no number", row + ", column " + column, "a finite number", ""});
}

}  // namespace

CsvReader::CsvReader(std::string_view text, std::string where, char separator)
    : m_text(text), m_where(std::move(where)), m_separator(separator)
{
    constexpr std::string_view byteOrderMark = "\xEF\xBB\xBF";
    if (m_text.starts_with(byteOrderMark)) m_text.remove_prefix(byteOrderMark.size());
    do {
        if (atEnd()) throw protocols::badInput({"is empty", m_where, "a header row", ""});
        readRecord();
    } while (isEmptyLine());
    std::set<std::string_view> seen;
    for (const std::string& name : m_cells) m_columns.emplace_back(withoutBlanks(name));
    for (const std::string& name : m_columns)
        if (!name.empty() && !seen.insert(name).second)
            throw protocols::badInput({"the column \"" + name + "\" occurs twice", m_where, "each column once", ""});
}

std::optional<std::size_t> CsvReader::column(std::string_view name) const { return placeOf(m_columns, name); }

bool CsvReader::next()
{
    do {
        if (atEnd()) return false;
        readRecord();
    } while (isEmptyLine());
    ++m_rows;
    if (m_cells.size() != m_columns.size())
        throw protocols::badInput({"has " + std::to_string(m_cells.size()) + " cells",
                                   m_where + ", row " + std::to_string(m_rows),
                                   std::to_string(m_columns.size()) + ", as the header", ""});
    return true;
}

double CsvReader::number(std::size_t column) const
{
    const std::string& cell = m_cells[column];
    // The name of the row is made only for a fault: this is called 10^7 times.
    const auto value = numberIn(cell);
    return value ? *value : numberOrFault(cell, m_where + ", row " + std::to_string(m_rows), m_columns[column]);
}

/// One line break ends a record unless it stands in quotes.
void CsvReader::readRecord()
{
    std::size_t count = 0;
    while (true) {
        if (m_cells.size() <= count) m_cells.emplace_back();
        readCell(m_cells[count++]);
        if (atEnd() || m_text[m_at] != m_separator) break;
        ++m_at;
    }
    m_cells.resize(count);
    if (!atEnd() && m_text[m_at] == '\r') ++m_at;
    if (!atEnd() && m_text[m_at] == '\n') ++m_at;
}

void CsvReader::readCell(std::string& cell)
{
    if (!atEnd() && m_text[m_at] == '"') {
        readQuotedCell(cell);
        return;
    }
    const std::size_t start = m_at;
    while (!atEnd() && m_text[m_at] != m_separator && m_text[m_at] != '\n' && m_text[m_at] != '\r') ++m_at;
    cell.assign(m_text.substr(start, m_at - start));
}

void CsvReader::readQuotedCell(std::string& cell)
{
    cell.clear();
    for (++m_at; !atEnd(); ++m_at) {
        if (m_text[m_at] != '"') {
            cell += m_text[m_at];
        } else if (m_at + 1 < m_text.size() && m_text[m_at + 1] == '"') {
            cell += '"';
            ++m_at;
        } else {
            ++m_at;
            if (!atEnd() && m_text[m_at] != m_separator && m_text[m_at] != '\n' && m_text[m_at] != '\r')
                throw protocols::badInput({"text follows a closing quote", m_where, "a separator or the end of the line", ""});
            return;
        }
    }
    throw protocols::badInput({"a quote is never closed", m_where, "cells quoted as RFC 4180 says", ""});
}

bool CsvReader::isEmptyLine() const { return m_cells.size() == 1 && withoutBlanks(m_cells[0]).empty(); }

std::optional<std::size_t> CsvTable::column(std::string_view name) const { return placeOf(columns, name); }

CsvTable csvTableFrom(std::string_view text, const std::string& where, char separator)
{
    CsvReader reader(text, where, separator);
    CsvTable table{where, reader.columns(), {}};
    while (reader.next()) table.rows.push_back(reader.cells());
    return table;
}

CsvTable readCsvTable(const std::filesystem::path& file, char separator)
{
    return csvTableFrom(readWholeFile(file), file.string(), separator);
}

std::optional<double> numberIn(std::string_view text)
{
    text = withoutBlanks(text);
    if (text.starts_with('+')) text.remove_prefix(1);
    double value = 0;
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (problem != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
    return value;
}

double numberAt(const CsvTable& table, std::size_t row, std::size_t column)
{
    const std::string& cell = table.rows[row][column];
    const auto value = numberIn(cell);
    return value ? *value : numberOrFault(cell, rowName(table, row), table.columns[column]);
}

std::string rowName(const CsvTable& table, std::size_t row) { return table.where + ", row " + std::to_string(row + 1); }

std::string csvCell(const std::string& text)
{
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) {
        if (c == '"') quoted += '"';
        quoted += c;
    }
    return quoted + '"';
}

std::string shortest(double value)
{
    char buffer[40];
    const auto [end, problem] = std::to_chars(buffer, buffer + sizeof buffer, value);
    return std::string(buffer, problem == std::errc{} ? end : buffer);
}

}  // namespace rendering::fabrics
