// Cells of a table, one function for each kind of content.
#pragma once

#include <cstddef>
#include <string>

#include "reports/formats/table.h"
#include "stats/kernels/value.h"

namespace reports {

TableCell textCell(const std::string& text);
/// Text that the page does not break into lines.
TableCell oneLineCell(const std::string& text);
/// Text in a column of numbers: "27/70", "8, 72".
TableCell numericTextCell(const std::string& text);
TableCell conditionCell(const std::string& condition);
/// An empty place in a column of numbers.
TableCell blankCell();
TableCell numberCell(const stats::Value& value, int decimals);
TableCell countCell(std::size_t n);
/// A p value too small for a double has no text.
TableCell pCell(const stats::Value& p);
TableCell pCell(const stats::Value& p, const stats::Value& logP);
TableCell intervalCell(const stats::Interval& interval, int decimals);
/// "−1.20 to 0.45".
TableCell rangeCell(double low, double high, int decimals);
/// "5.1 ± 1.9". The CSV has only the mean here; the SD has its own column.
TableCell meanSdCell(const stats::Value& mean, const stats::Value& sd, int decimals);

/// The name of a question's own column: its id, unless the column of conditions has that name.
std::string questionColumn(const std::string& question);

}  // namespace reports
