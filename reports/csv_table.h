// Comma-separated values by RFC 4180: quoted fields, doubled quotes, line breaks inside quotes.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace reports {

struct CsvRow {
    std::size_t line = 0;  ///< in the file, from 1
    std::vector<std::string> cells;
};

struct CsvTable {
    std::vector<std::string> header;
    std::vector<CsvRow> rows;

    std::optional<std::size_t> column(std::string_view name) const;
};

/// A byte-order mark and CRLF are accepted; empty lines are skipped. `where` names the text in errors.
/// Throws badInput with the line: no header, a doubled column name, a row of another length, a quote
/// that is not closed or stands inside a field.
CsvTable parseCsv(std::string_view text, const std::string& where);

/// Throws badInput where the file cannot be read.
CsvTable readCsv(const std::filesystem::path& file);

/// Empty, "NA" and "NaN" cells are missing.
bool isMissing(std::string_view cell);

/// The finite number of a whole cell; none where it is missing. Throws badInput naming line and column.
std::optional<double> numberOf(const CsvTable& table, const CsvRow& row, std::size_t column, const std::string& where);

/// A field as written: quoted where it must be.
std::string csvField(const std::string& text);

}  // namespace reports
