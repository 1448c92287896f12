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
