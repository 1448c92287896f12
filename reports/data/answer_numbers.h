// The numbers, marks and scores of a table of answers, with faults that name the cell that has to change.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>

#include "protocols/files/csv_table.h"

namespace reports {

/// One cell in another form keeps a whole column of decimal commas from being read. Where most cells of the column have such
/// numbers, throws badInput naming the first cell that has none. A column of numbers with points passes.
void requireOneDecimalMark(const protocols::CsvTable& table, std::size_t column);

/// The number in a cell, as protocols::numberAt() reads it; for a decimal comma, first throws as requireOneDecimalMark() does.
double answerNumberAt(const protocols::CsvTable& table, std::size_t row, std::size_t column);

/// The same; none where the value is missing.
std::optional<double> answerNumberOrMissing(const protocols::CsvTable& table, std::size_t row, std::size_t column);

/// A whole number from 1, as a trial has it; none where there is no such column or the cell is missing. Throws badInput for any
/// other number.
std::optional<int> countIn(const protocols::CsvTable& table, std::size_t row, const std::optional<std::size_t>& column);

/// Seconds; none where there is no such column or the time is missing. Throws badInput for a negative one: some programs write
/// -999 for a missing one, which no mean may hold.
std::optional<double> secondsIn(const protocols::CsvTable& table, std::size_t row, const std::optional<std::size_t>& column);

/// What 1 and 0 of a mark mean, for messages.
struct MarkWords {
    const char* one;
    const char* zero;
};

/// 1 or 0 as true or false; none where the value is missing. Throws badInput for anything else. Words such as TRUE and FALSE are
/// numbers by then (readAnswerRows).
std::optional<bool> markAt(const protocols::CsvTable& table, std::size_t row, std::size_t column, const MarkWords& words);

/// "same" or "different", in any case of letters. Whether a pair was the same follows from this word, so that any other word
/// throws badInput.
std::string sameOrDifferentAt(const protocols::CsvTable& table, std::size_t row, std::size_t column);

/// A choice whose answer has the name of a fabric.
struct ScoredChoice {
    std::size_t row = 0, score = 0;  ///< the cell of the score
    bool correct = false;
    std::string chosen, fabric;  ///< `fabric` is that of the rendering
    bool isOnTray = false;       ///< the row lists the alternatives, and the answer is one of them
};

/// The scores of one question beside its answers. An answer may have the name of a fabric and mean something else, such as a
/// place on the tray. So only what is certain is a fault, and the rest is counted for a note.
class ScoresOfAnswers {
public:
    explicit ScoresOfAnswers(std::string question) : m_question(std::move(question)) {}

    /// Throws badInput, naming the cell, where the answer is on the tray and contradicts the score.
    void add(const protocols::CsvTable& table, const ScoredChoice& choice);

    /// Throws badInput, naming the first cell, where each of at least 5 scores contradicts its answer: 0 and 1 are exchanged.
    void requireRightAsOne(const protocols::CsvTable& table) const;

    /// "in 12 of 40 rows the answer to Q1 names ..., but the score says ..."; empty where no score contradicts.
    std::string note() const;

private:
    std::string m_question;
    std::optional<ScoredChoice> m_first;  ///< that contradicts
    std::size_t m_rows = 0, m_ownAsWrong = 0, m_otherAsRight = 0;
};

}  // namespace reports
