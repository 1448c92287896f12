// Comma-separated tables by RFC 4180: quotes, doubled quotes, separators and line breaks inside quotes. A line ends with LF,
// CRLF, CR or CRCRLF. Every fault names file and row. Numbers do not depend on the locale.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace protocols {

/// Most columns of a table: as many as a sheet of a spreadsheet has.
inline constexpr std::size_t mostColumns = 16'384;

/// Most cells of a table that is kept as a whole, where each row counts as two cells more. They take 1 GB; the answers of a large
/// study, 252,000 rows of 40 columns, are 10.6 million.
inline constexpr std::size_t mostCells = 30'000'000;

/// Rows one after another, for records too long to be kept as text: 10^7 rows of three numbers take 1.5 GB as cells.
class CsvReader {
public:
    /// Reads the header row. `text` must outlive the reader; `where` names it in errors; `separator` is a comma, a
    /// semicolon or a tab. Throws badInput where the text is empty, a row has more than
    /// `mostColumns` cells, or a column name occurs twice or has more than 1000 bytes.
    CsvReader(std::string_view text, std::string where, char separator = ',');

    /// Without the blanks around each name.
    const std::vector<std::string>& columns() const { return m_columns; }
    std::optional<std::size_t> column(std::string_view name) const;

    /// Reads the next row; false at the end. Blank lines are no rows, but in a table of one column each is a missing value,
    /// unless only blank lines follow. A cell in quotes is never blank. Throws badInput if the number of cells differs from the
    /// header's. Throws it, too, for a quote that is never closed and for one inside a cell without quotes.
    bool next();
    const std::vector<std::string>& cells() const { return m_cells; }
    std::size_t rows() const { return m_rows; }  ///< number of rows read so far, without the header
    std::size_t line() const { return m_line; }  ///< line of the text at which the row begins, from 1

    /// The number in a cell of the row that next() read. Throws badInput naming row and column.
    double number(std::size_t column) const;

    const std::string& where() const { return m_where; }
    std::string rowName() const;  ///< "FILE, row 2 (line 3)"

private:
    void readRecord();
    void readCell(std::string& cell);
    void readQuotedCell(std::string& cell);
    bool isBlankLine() const;
    bool isNoRow() const;
    bool isAtEnd() const { return m_at >= m_text.size(); }
    bool isAtCellEnd() const;
    std::string lineName() const;

    std::string_view m_text;
    std::string m_where;
    char m_separator;
    std::size_t m_at = 0, m_rows = 0, m_line = 0, m_nextLine = 1;
    std::size_t m_start = 0;     ///< of the record that was read last
    std::size_t m_afterContent;  ///< from here on the text is blank
    std::vector<std::string> m_columns, m_cells;
};

/// A whole table as text.
struct CsvTable {
    std::string where;  ///< the file, for faults
    std::vector<std::string> columns;
    std::vector<std::vector<std::string>> rows;  ///< each as long as `columns`
    std::vector<std::size_t> lines;              ///< line of each row in the text, from 1

    std::optional<std::size_t> column(std::string_view name) const;
};

/// Throws badInput as CsvReader does, and for more than `cells` cells. foreign_table.h reads files, whose separator is not
/// known.
CsvTable csvTableFrom(std::string_view text, const std::string& where, char separator = ',', std::size_t cells = mostCells);

/// "FILE, row 2 (line 3)": rows count from 1 after the header, lines from 1 with it.
std::string rowName(const CsvTable& table, std::size_t row);

/// The number in a cell. Throws badInput naming row and column.
double numberAt(const CsvTable& table, std::size_t row, std::size_t column);

/// Empty, "NA" and "NaN" cells are missing values.
bool isMissing(std::string_view cell);

/// The number in a cell, or nothing where the value is missing. Throws badInput naming row and column.
std::optional<double> numberOrMissing(const CsvTable& table, std::size_t row, std::size_t column);

/// One cell, quoted where RFC 4180 asks for it.
std::string csvCell(std::string_view text, char separator = ',');

/// One row of cells with its line break (LF). A blank cell that is the whole row stands in quotes, so that it is read again.
std::string csvRow(const std::vector<std::string>& cells, char separator = ',');

}  // namespace protocols
