#include "reports/data/answer_numbers.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

#include "protocols/files/errors.h"
#include "protocols/files/number_text.h"
#include "protocols/files/utf8.h"
#include "reports/data/answer_rows.h"
#include "reports/text/plain_words.h"

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

/// Fewer contradictions than this may come by chance, where the answers are places that are called like fabrics.
constexpr std::size_t fewestExchanged = 5;

/// A name such as Q1_slot would be refused as a part of Q1.
constexpr const char* whereNoFabrics = "where the answers name no fabrics, call their column otherwise, such as slot";

std::string contradictionIn(const ScoredChoice& choice)
{
    const std::string other =
        choice.chosen == choice.fabric ? "the fabric of the row" : "not the fabric of the row, " + choice.fabric;
    return "the answer " + choice.chosen + " is " + other + ", but it counts as " + (choice.correct ? "right" : "wrong");
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

std::optional<int> countIn(const protocols::CsvTable& table, std::size_t row, const std::optional<std::size_t>& column)
{
    const auto number = column ? answerNumberOrMissing(table, row, *column) : std::nullopt;
    if (!number) return std::nullopt;
    constexpr double largest = 1e9;
    if (*number >= 1 && *number <= largest && *number == std::floor(*number)) return static_cast<int>(*number);
    throw protocols::badInput({"\"" + table.rows[row][*column] + "\" is not a whole number", placeOfCell(table, row, *column),
                               "a whole number from 1", ""});
}

std::optional<double> secondsIn(const protocols::CsvTable& table, std::size_t row, const std::optional<std::size_t>& column)
{
    const auto taken = column ? answerNumberOrMissing(table, row, *column) : std::nullopt;
    if (!taken || *taken >= 0) return taken;
    throw protocols::badInput({"the time " + table.rows[row][*column] + " is negative", placeOfCell(table, row, *column),
                               "seconds from 0", "a time is not negative: leave the cells of missing times empty"});
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

std::string sameOrDifferentAt(const protocols::CsvTable& table, std::size_t row, std::size_t column)
{
    const std::string& given = table.rows[row][column];
    std::string word = lowerCase(std::string(nameWithoutBlanks(given)));
    if (word == "same" || word == "different") return word;
    throw protocols::badInput({quotedCell(given) + " is neither same nor different", placeOfCell(table, row, column),
                               "same or different", "replace the words of the column, or leave its cells empty"});
}

void ScoresOfAnswers::add(const protocols::CsvTable& table, const ScoredChoice& choice)
{
    ++m_rows;
    const bool isRight = choice.chosen == choice.fabric;
    if (isRight == choice.correct) return;
    if (choice.isOnTray)
        throw protocols::badInput({contradictionIn(choice), placeOfCell(table, choice.row, choice.score),
                                   isRight ? "1 (right)" : "0 (wrong)", "correct the score or the answer"});
    ++(isRight ? m_ownAsWrong : m_otherAsRight);
    if (!m_first) m_first = choice;
}

void ScoresOfAnswers::requireRightAsOne(const protocols::CsvTable& table) const
{
    if (m_rows < fewestExchanged || m_ownAsWrong + m_otherAsRight < m_rows) return;
    throw protocols::badInput(
        {"all " + std::to_string(m_rows) + " scores of " + m_question + " contradict their answers: " + contradictionIn(*m_first),
         placeOfCell(table, m_first->row, m_first->score), "1 where the answer is the fabric of the row, else 0",
         "exchange 0 and 1; or, " + std::string(whereNoFabrics)});
}

std::string ScoresOfAnswers::note() const
{
    if (!m_first) return {};
    std::string text;
    const auto addRows = [&](std::size_t rows, const char* contradiction) {
        if (rows == 0) return;
        text += (text.empty() ? "in " : "; in ") + std::to_string(rows) + " of " + std::to_string(m_rows) +
                " rows the answer to " + m_question + " names " + contradiction;
    };
    addRows(m_ownAsWrong, "the fabric of the row, but the score says wrong");
    addRows(m_otherAsRight, "another fabric, but the score says right");
    return text + "; correct these rows, or, " + whereNoFabrics;
}

}  // namespace reports
