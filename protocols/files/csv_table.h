// Comma-separated tables by RFC 4180 (quotes, doubled quotes, line breaks within quotes, LF or CRLF),
// with the file and row in every fault. Numbers never depend on the locale.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rendering::fabrics {

struct CsvTable {
    std::string where;                           ///< the file, for faults
    std::vector<std::string> columns;            ///< blanks around the names are cut off
    std::vector<std::vector<std::string>> rows;  ///< each as long as `columns`

    std::optional<std::size_t> column(std::string_view name) const;
};

/// The same rows one after another, for records too long to be kept as text: 10^7 rows of three numbers take
/// 1.5 GB as cells.
class CsvReader {
public:
    /// Reads the header; `text` must outlive the reader. Throws badInput as readCsvTable().
    CsvReader(std::string_view text, std::string where, char separator = ',');

    const std::vector<std::string>& columns() const { return m_columns; }
    std::optional<std::size_t> column(std::string_view name) const;

    /// False at the end. Throws badInput for a row of another length or an open quote.
    bool next();
    const std::vector<std::string>& cells() const { return m_cells; }
    std::size_t rows() const { return m_rows; }  ///< read so far; the first after the header is 1

    /// The number in a cell of the row that next() read; throws badInput naming row and column.
    double number(std::size_t column) const;

    const std::string& where() const { return m_where; }

private:
    void readRecord();
    void readCell(std::string& cell);
    void readQuotedCell(std::string& cell);
    bool isEmptyLine() const;
    bool atEnd() const { return m_at >= m_text.size(); }

    std::string_view m_text;
    std::string m_where;
    char m_separator;
    std::size_t m_at = 0, m_rows = 0;
    std::vector<std::string> m_columns, m_cells;
};

/// Throws badInput: no header row, a row with another number of cells, an open quote, a name that occurs twice.
/// Empty lines are passed over. `separator` is a comma, semicolon or tab.
CsvTable readCsvTable(const std::filesystem::path& file, char separator = ',');
CsvTable csvTableFrom(std::string_view text, const std::string& where, char separator = ',');

/// A finite number, all of the text but blanks around it.
std::optional<double> numberIn(std::string_view text);

/// The number in a cell; throws badInput naming row (the first after the header is 1) and column.
double numberAt(const CsvTable& table, std::size_t row, std::size_t column);

/// "FILE, row 3": rows count from 1 after the header.
std::string rowName(const CsvTable& table, std::size_t row);

/// A cell, quoted where RFC 4180 asks for it.
std::string csvCell(const std::string& text);

/// The shortest text that reads back exactly.
std::string shortest(double value);

}  // namespace rendering::fabrics
