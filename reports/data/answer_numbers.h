// The numbers of a table of answers, with faults that name the cell that has to change.
#pragma once

#include <cstddef>
#include <optional>

#include "protocols/files/csv_table.h"

namespace reports {

/// One cell in another form keeps a whole column of decimal commas from being read. Where most cells of the column have such
/// numbers, throws badInput naming the first cell that has none. A column of numbers with points passes.
void requireOneDecimalMark(const protocols::CsvTable& table, std::size_t column);

/// The number in a cell, as protocols::numberAt() reads it; for a decimal comma, first throws as requireOneDecimalMark() does.
double answerNumberAt(const protocols::CsvTable& table, std::size_t row, std::size_t column);

/// The same; none where the value is missing.
std::optional<double> answerNumberOrMissing(const protocols::CsvTable& table, std::size_t row, std::size_t column);

/// What 1 and 0 of a mark mean, for messages.
struct MarkWords {
    const char* one;
    const char* zero;
};

/// 1 or 0 as true or false; none where the value is missing. Throws badInput for anything else. Words such as TRUE and FALSE are
/// numbers by then (readAnswerRows).
std::optional<bool> markAt(const protocols::CsvTable& table, std::size_t row, std::size_t column, const MarkWords& words);

}  // namespace reports
