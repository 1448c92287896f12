#include "rendering/fabrics/csv_table.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>

#include "protocols/errors.h"
#include "rendering/whole_file.h"

namespace rendering::fabrics {

namespace {

std::string_view withoutBlanks(std::string_view text)
{
    constexpr std::string_view blanks = " \t\r\n";
    const auto first = text.find_first_not_of(blanks);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

/// Cuts records and cells; one line break ends a record unless it stands in quotes.
class Cutter {
public:
    Cutter(std::string_view text, char separator, const std::string& where) : m_text(text), m_separator(separator), m_where(where)
    {
    }

    bool atEnd() const { return m_at >= m_text.size(); }

    std::vector<std::string> record()
    {
        std::vector<std::string> cells;
        while (true) {
            cells.push_back(cell());
            if (!atEnd() && m_text[m_at] == m_separator) {
                ++m_at;
                continue;
            }
            skipLineBreak();
            return cells;
        }
    }

private:
    std::string cell()
    {
        if (!atEnd() && m_text[m_at] == '"') return quotedCell();
        const std::size_t start = m_at;
        while (!atEnd() && m_text[m_at] != m_separator && m_text[m_at] != '\n' && m_text[m_at] != '\r') ++m_at;
        return std::string(m_text.substr(start, m_at - start));
    }

    std::string quotedCell()
    {
        std::string content;
        for (++m_at; !atEnd(); ++m_at) {
            if (m_text[m_at] != '"') {
                content += m_text[m_at];
            } else if (m_at + 1 < m_text.size() && m_text[m_at + 1] == '"') {
                content += '"';
                ++m_at;
            } else {
                ++m_at;
                if (!atEnd() && m_text[m_at] != m_separator && m_text[m_at] != '\n' && m_text[m_at] != '\r')
                    throw protocols::badInput(
                        {"text follows a closing quote", m_where, "a separator or the end of the line", ""});
                return content;
            }
        }
        throw protocols::badInput({"a quote is never closed", m_where, "cells quoted as RFC 4180 says", ""});
    }

    void skipLineBreak()
    {
        if (!atEnd() && m_text[m_at] == '\r') ++m_at;
        if (!atEnd() && m_text[m_at] == '\n') ++m_at;
    }

    std::string_view m_text;
    char m_separator;
    const std::string& m_where;
    std::size_t m_at = 0;
};

bool isEmptyLine(const std::vector<std::string>& record) { return record.size() == 1 && withoutBlanks(record[0]).empty(); }

}  // namespace

std::optional<std::size_t> CsvTable::column(std::string_view name) const
{
    const auto found = std::find(columns.begin(), columns.end(), name);
    return found == columns.end() ? std::nullopt : std::optional(std::size_t(found - columns.begin()));
}

CsvTable csvTableFrom(std::string_view text, const std::string& where, char separator)
{
    constexpr std::string_view byteOrderMark = "\xEF\xBB\xBF";
    if (text.starts_with(byteOrderMark)) text.remove_prefix(byteOrderMark.size());
    CsvTable table{where, {}, {}};
    Cutter cutter(text, separator, where);
    while (!cutter.atEnd() && table.columns.empty()) {
        const auto header = cutter.record();
        if (!isEmptyLine(header))
            for (const std::string& name : header) table.columns.emplace_back(withoutBlanks(name));
    }
    if (table.columns.empty()) throw protocols::badInput({"is empty", where, "a header row", ""});
    std::set<std::string> seen;
    for (const std::string& name : table.columns)
        if (!name.empty() && !seen.insert(name).second)
            throw protocols::badInput({"the column \"" + name + "\" occurs twice", where, "each column once", ""});
    while (!cutter.atEnd()) {
        auto record = cutter.record();
        if (isEmptyLine(record)) continue;
        table.rows.push_back(std::move(record));
        if (table.rows.back().size() != table.columns.size())
            throw protocols::badInput({"has " + std::to_string(table.rows.back().size()) + " cells",
                                       rowName(table, table.rows.size() - 1),
                                       std::to_string(table.columns.size()) + ", as the header", ""});
    }
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
    if (const auto value = numberIn(cell)) return *value;
    throw protocols::badInput({cell.empty() ? "is empty" : "\"" + cell + "\" is no number",
                               rowName(table, row) + ", column " + table.columns[column], "a finite number", ""});
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
