#include "reports/data/answer_numbers.h"

#include <algorithm>
#include <string>
#include <string_view>

#include "protocols/files/errors.h"
#include "protocols/files/number_text.h"
#include "protocols/files/utf8.h"
#include "reports/data/answer_rows.h"

namespace reports {

namespace {

/// How a cell of a column of numbers is written.
enum class NumberForm { Missing, Whole, Comma, Point, None };

NumberForm formOf(std::string_view cell)
{
    if (protocols::isMissing(cell)) return NumberForm::Missing;
    if (protocols::numberIn(cell)) return cell.find('.') == std::string_view::npos ? NumberForm::Whole : NumberForm::Point;
    std::string number(protocols::withoutBlanks(cell));
    const std::size_t comma = number.find(',');
    if (comma == std::string::npos || comma + 1 == number.size()) return NumberForm::None;
    number[comma] = '.';
    return protocols::numberIn(number) ? NumberForm::Comma : NumberForm::None;
}

/// The first row whose cell keeps the column from being read with decimal commas; none where few cells have them.
std::optional<std::size_t> rowAgainstCommas(const protocols::CsvTable& table, std::size_t column)
{
    std::size_t commas = 0, points = 0, whole = 0, filled = 0;
    std::optional<std::size_t> first;
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
        const NumberForm form = formOf(table.rows[row][column]);
        commas += form == NumberForm::Comma ? 1 : 0;
        points += form == NumberForm::Point ? 1 : 0;
        whole += form == NumberForm::Whole ? 1 : 0;
        filled += form == NumberForm::Missing ? 0 : 1;
        if (!first && (form == NumberForm::Point || form == NumberForm::None)) first = row;
    }
    return commas > points && 2 * (commas + whole) > filled ? first : std::nullopt;
}

std::string quotedCell(const std::string& cell)
{
    constexpr std::size_t longestShown = 60;
    return "\"" + protocols::inShort(cell, longestShown) + "\"";
}

std::string placeOfCell(const protocols::CsvTable& table, std::size_t row, std::size_t column)
{
    return protocols::rowName(table, row) + ", column " + table.columns[column];
}

void requirePoint(const protocols::CsvTable& table, std::size_t row, std::size_t column)
{
    const std::string& cell = table.rows[row][column];
    if (cell.find(',') == std::string::npos || formOf(cell) != NumberForm::Comma) return;
    requireOneDecimalMark(table, column);
    throw protocols::badInput({quotedCell(cell) + " is not a number", placeOfCell(table, row, column),
                               "a decimal point, or decimal commas in the whole column of a table with semicolons or tabs", ""});
}

}  // namespace

void requireOneDecimalMark(const protocols::CsvTable& table, std::size_t column)
{
    if (const auto row = rowAgainstCommas(table, column))
        throw protocols::badInput({quotedCell(table.rows[*row][column]) + " is not a number with a decimal comma",
                                   placeOfCell(table, *row, column),
                                   "a number such as 3,2, as most cells of the column have it; an empty cell, NA or NaN for a "
                                   "missing value",
                                   "correct this cell; where commas separate the columns, write every number with a point"});
}

double answerNumberAt(const protocols::CsvTable& table, std::size_t row, std::size_t column)
{
    requirePoint(table, row, column);
    return protocols::numberAt(table, row, column);
}

std::optional<double> answerNumberOrMissing(const protocols::CsvTable& table, std::size_t row, std::size_t column)
{
    requirePoint(table, row, column);
    return protocols::numberOrMissing(table, row, column);
}

std::optional<bool> markAt(const protocols::CsvTable& table, std::size_t row, std::size_t column, const MarkWords& words)
{
    const std::string& cell = table.rows[row][column];
    if (protocols::isMissing(cell)) return std::nullopt;
    const auto number = protocols::numberIn(cell);
    if (number == 0.0 || number == 1.0) return number == 1.0;
    throw protocols::badInput(
        {quotedCell(cell) + " is neither " + words.one + " nor " + words.zero, placeOfCell(table, row, column),
         "1 (" + std::string(words.one) + ") or 0 (" + words.zero + "); or one of the words " + wordsForScores(),
         "replace the words; an empty cell is a missing value"});
}

}  // namespace reports
