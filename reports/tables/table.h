// A table once, written in four ways: CSV with full digits, LaTeX (booktabs) and HTML with sensible
// ones, text for a terminal.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "stats/kernels/value.h"

namespace reports {

struct TableCell {
    std::string text;  ///< terminal
    std::string csv;
    std::string html;  ///< already escaped
    std::string tex;   ///< already escaped
    std::string why;   ///< reason of a value that does not exist; shown as a tooltip
    bool isNumber = false;
};

TableCell textCell(const std::string& text);
TableCell conditionCell(const std::string& condition);
/// An empty place in a column of numbers.
TableCell blankCell();
TableCell numberCell(const stats::Value& value, int decimals);
TableCell countCell(std::size_t n);
TableCell pCell(const stats::Value& p);
TableCell intervalCell(const stats::Interval& interval, int decimals);
/// "5.1 ± 1.9"; CSV carries the mean alone, the SD has its own column there.
TableCell meanSdCell(const stats::Value& mean, const stats::Value& sd, int decimals);

/// Where a column is shown: machines want ends of an interval apart, readers want them together.
enum class Shown { Everywhere, InCsv, InDocuments };

struct TableColumn {
    std::string name;
    Shown shown = Shown::Everywhere;

    TableColumn(std::string columnName, Shown where = Shown::Everywhere) : name(std::move(columnName)), shown(where) {}
    TableColumn(const char* columnName, Shown where = Shown::Everywhere) : name(columnName), shown(where) {}
};

struct Table {
    std::string name;  ///< of its files, "q1_matches"
    std::string caption;
    std::vector<TableColumn> columns;
    std::vector<std::vector<TableCell>> rows;

    bool isInCsv(std::size_t column) const { return columns[column].shown != Shown::InDocuments; }
    bool isInDocuments(std::size_t column) const { return columns[column].shown != Shown::InCsv; }
};

/// "−0.25": a real minus sign.
std::string typeset(const std::string& number);

std::string toCsv(const Table& table);
std::string toTex(const Table& table);
std::string toHtml(const Table& table);
std::string toText(const Table& table);

}  // namespace reports
