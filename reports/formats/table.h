// A table as a value: named columns, and cells that carry their text for each format.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace reports {

struct TableCell {
    std::string text;  ///< for a terminal
    std::string csv;   ///< with full digits, not yet quoted
    std::string html;  ///< already escaped
    std::string tex;   ///< already escaped
    std::string why;   ///< reason of a value that does not exist; the page shows it as a tooltip
    bool isNumber = false;
};

/// The CSV has the ends of an interval in two columns; documents have them in one.
enum class ColumnUse { Everywhere, InCsv, InDocuments };

struct TableColumn {
    std::string name;
    ColumnUse use = ColumnUse::Everywhere;

    TableColumn(std::string columnName, ColumnUse where = ColumnUse::Everywhere) : name(std::move(columnName)), use(where) {}
    TableColumn(const char* columnName, ColumnUse where = ColumnUse::Everywhere) : name(columnName), use(where) {}
};

struct Table {
    std::string name;  ///< name of its files, "q1_matches"
    std::string caption;
    std::vector<TableColumn> columns;
    std::vector<std::vector<TableCell>> rows;  ///< one cell a column

    bool isInCsv(std::size_t column) const { return columns[column].use != ColumnUse::InDocuments; }
    bool isInDocuments(std::size_t column) const { return columns[column].use != ColumnUse::InCsv; }
};

}  // namespace reports
