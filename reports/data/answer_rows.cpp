#include "reports/data/answer_rows.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <utility>

#include "protocols/files/errors.h"
#include "protocols/files/foreign/foreign_table.h"
#include "protocols/files/number_text.h"
#include "reports/data/long_table.h"
#include "reports/data/table_marks.h"
#include "reports/text/plain_words.h"

namespace reports {

namespace {

using protocols::CsvTable;

/// Words for right and wrong in the spreadsheets of several languages, in lower case.
constexpr std::array<std::string_view, 5> wordsForRight{"true", "wahr", "vrai", "yes", "right"};
constexpr std::array<std::string_view, 5> wordsForWrong{"false", "falsch", "faux", "no", "wrong"};

void writeZeroOrOne(std::string& cell)
{
    const std::string word = lowerCase(std::string(protocols::withoutBlanks(cell)));
    if (std::ranges::find(wordsForRight, word) != wordsForRight.end()) cell = "1";
    if (std::ranges::find(wordsForWrong, word) != wordsForWrong.end()) cell = "0";
}

/// Every column is named as in the file: `--map Q2=Q1 --map Q3=Q2` moves two columns.
void renameColumns(CsvTable& table, const std::vector<std::pair<std::string, std::string>>& names)
{
    std::map<std::size_t, std::string> meanings;
    std::set<std::string> given;
    const auto refuseTwice = [&](const std::string& what) {
        throw protocols::badInput(
            {what, table.where + ", header row", "one --map for each column and each meaning", "leave out one of the two --map"});
    };
    for (const auto& [meaning, name] : names) {
        const auto column = table.column(name);
        if (!column)
            throw protocols::badInput({"there is no column \"" + name + "\"", table.where + ", header row",
                                       "one of " + listed(table.columns), "name the columns by --map MEANING=COLUMN"});
        if (!meanings.emplace(*column, meaning).second) refuseTwice("the column \"" + name + "\" is given two meanings");
        if (!given.insert(meaning).second) refuseTwice("two columns are given the meaning \"" + meaning + "\"");
    }
    for (const std::string& meaning : given)
        if (const auto taken = table.column(meaning); taken && !meanings.contains(*taken))
            table.columns[*taken] += " (in the file)";
    for (const auto& [column, meaning] : meanings) table.columns[column] = meaning;
}

/// "P01 " and "P01" are one participant, whom one blank would make two of.
void trimNames(CsvTable& table)
{
    std::vector<std::size_t> columns;
    for (const std::string_view name : keyColumns)
        if (const auto column = table.column(name)) columns.push_back(*column);
    for (const char* name : {"question", anchorColumn, stateColumn, kindColumn})
        if (const auto column = table.column(name)) columns.push_back(*column);
    for (auto& row : table.rows)
        for (const std::size_t column : columns)
            if (const auto name = nameWithoutBlanks(row[column]); name.size() != row[column].size())
                row[column] = std::string(name);
}

/// Right and wrong in words become 1 and 0. So do voided and late, which a long table has for each answer.
void readWordsForMarks(CsvTable& table)
{
    const bool isLong = table.column("question").has_value();
    for (std::size_t column = 0; column < table.columns.size(); ++column) {
        const std::string& name = table.columns[column];
        if (name == "correct" || name.ends_with("_correct") || (isLong && (name == "voided" || name == "late")))
            for (auto& row : table.rows) writeZeroOrOne(row[column]);
    }
}

/// A table of one question may leave its name out. One whose columns name questions is wide: its `rating` is of something else.
void nameTheOnlyQuestion(CsvTable& table)
{
    const bool isWide = std::ranges::any_of(
        table.columns, [](const std::string& name) { return isUsualQuestion(name) || name.ends_with("_correct"); });
    if (isWide || table.column("question") || table.column("correct").has_value() == table.column("rating").has_value()) return;
    table.columns.emplace_back("question");
    for (auto& row : table.rows) row.emplace_back("Q1");
}

/// The kinds of participants that a column of an export names; empty without such a column.
std::set<std::string> kindsIn(const CsvTable& table)
{
    std::set<std::string> kinds;
    if (!namesKinds(table)) return kinds;
    const std::size_t column = *table.column(kindColumn);
    for (const auto& row : table.rows) kinds.insert(row[column]);
    return kinds;
}

/// Of a wide table; in a long one each answer has its state.
void leaveOutWithdrawn(CsvTable& table, AnswerRows& rows)
{
    const std::size_t column = *table.column(stateColumn);
    std::size_t kept = 0;
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
        if (table.rows[row][column] == "withdrawn") continue;
        if (kept != row) {
            table.rows[kept] = std::move(table.rows[row]);
            table.lines[kept] = table.lines[row];
        }
        ++kept;
    }
    rows.ofWithdrawn = table.rows.size() - kept;
    table.rows.resize(kept);
    table.lines.resize(kept);
}

}  // namespace

std::string_view nameWithoutBlanks(std::string_view cell)
{
    constexpr std::string_view noBreakSpace = "\u00A0";
    while (true) {
        const std::size_t before = cell.size();
        cell = protocols::withoutBlanks(cell);
        while (cell.starts_with(noBreakSpace)) cell.remove_prefix(noBreakSpace.size());
        while (cell.ends_with(noBreakSpace)) cell.remove_suffix(noBreakSpace.size());
        if (cell.size() == before) return cell;
    }
}

std::string wordsForScores()
{
    std::string words;
    for (std::size_t i = 0; i < wordsForRight.size(); ++i)
        words.append(i == 0 ? "" : ", ").append(wordsForRight[i]).append("/").append(wordsForWrong[i]);
    return words;
}

AnswerRows readAnswerRows(const std::filesystem::path& file, const AnswerRowsOptions& options, int alternatives)
{
    protocols::ForeignTable foreign = protocols::readForeignTable(file, options.encoding);
    renameColumns(foreign.table, options.names);
    CsvTable& table = foreign.table;
    trimNames(table);
    nameTheOnlyQuestion(table);
    readWordsForMarks(table);
    AnswerRows rows;
    if (!foreign.isUsual) rows.taken = foreign.taken;
    rows.isOwnExport = isExport(table);
    rows.hasStates = namesStates(table);
    rows.answeredBy = kindsIn(table);
    rows.hasAnchors = namesAnchors(table);
    if (rows.hasAnchors) rows.choicesRepeatedAnew = questionsRepeatedAnew(table);
    if (table.column("question")) {
        rows.table.where = table.where;
        writeWideTable(table, alternatives, rows);
        return rows;
    }
    if (rows.hasStates) leaveOutWithdrawn(table, rows);
    rows.table = std::move(table);
    return rows;
}

}  // namespace reports
