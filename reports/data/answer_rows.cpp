#include "reports/data/answer_rows.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <tuple>

#include "protocols/condition.h"
#include "protocols/files/errors.h"
#include "protocols/files/foreign/foreign_table.h"
#include "protocols/files/number_text.h"
#include "protocols/protocol.h"
#include "reports/data/answer_numbers.h"
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

void rename(CsvTable& table, const std::string& meaning, const std::string& name)
{
    const auto column = table.column(name);
    if (!column)
        throw protocols::badInput({"there is no column \"" + name + "\"", table.where + ", header row",
                                   "one of " + listed(table.columns), "name the columns by --map MEANING=COLUMN"});
    if (const auto taken = table.column(meaning); taken && taken != column) table.columns[*taken] += " (in the file)";
    table.columns[*column] = meaning;
}

/// Columns of a long table that belong to the whole row.
constexpr std::array<std::string_view, 7> keyColumns{"participant", "fabric",     "condition",  "group",
                                                     "session",     "repetition", "instruction"};
/// Columns of a long table that belong to one answer.
constexpr std::array<std::string_view, 9> answerColumns{"question", "correct", "rating",           "answer", "seconds",
                                                        "trial",    "sitting", "response_seconds", "voided"};
/// Columns of an own export that say more about an answer.
constexpr std::array<std::string_view, 7> ownColumns{"place",      "state",   "alternatives", "answer_begun_at",
                                                     "touched_by", "entries", "late"};

/// Columns that only this program's export has together, also a public one, which has no times of day.
bool isExport(const CsvTable& table)
{
    return table.column("answer_begun_at") && table.column("stored_at") && table.column("alternatives") &&
           table.column("touched_by") && table.column("corrections");
}

/// Different questions that a long table of another lab may have. More are the sign of a column that holds something else.
constexpr std::size_t mostQuestions = 200;
/// Those of an own export are the questions of its protocol.
constexpr std::size_t mostOwnQuestions = 10'000;
/// Cells of the wide table. Each takes 32 bytes, and a small file can ask for very many.
constexpr std::size_t mostWideCells = 20'000'000;

constexpr const char* anchorColumn = "anchor";
constexpr const char* repetitionColumn = "repetition";

/// Whether the table has such a column, and it holds only kinds of anchors.
bool namesAnchors(const CsvTable& table)
{
    const auto column = table.column(anchorColumn);
    return column && std::ranges::all_of(table.rows, [&](const auto& row) {
               return protocols::isMissing(row[*column]) || protocols::anchorKindNamed(row[*column]);
           });
}

/// The pieces in a list as an export writes it: ["F02","F01"]. Ids hold no commas.
std::vector<std::string> piecesIn(std::string_view list)
{
    std::vector<std::string> pieces;
    if (!list.starts_with('[') || !list.ends_with(']')) return pieces;
    list = list.substr(1, list.size() - 2);
    while (!list.empty()) {
        const std::size_t end = std::min(list.find(','), list.size());
        std::string_view piece = list.substr(0, end);
        while (piece.starts_with(' ')) piece.remove_prefix(1);
        pieces.emplace_back(piece);
        list.remove_prefix(std::min(end + 1, list.size()));
    }
    return pieces;
}

/// The questions of a long table whose `alternatives` (a list as JSON, as an export writes it) hold other pieces where a choice
/// comes a second time.
std::set<std::string> questionsRepeatedAnew(const CsvTable& table)
{
    const auto pieces = table.column("alternatives"), anchor = table.column(anchorColumn), question = table.column("question");
    std::set<std::string> anew;
    if (!pieces || !anchor || !question) return anew;
    std::map<std::vector<std::string>, std::vector<std::string>> first;
    for (const bool isSecond : {false, true})
        for (const auto& row : table.rows) {
            const auto kind = protocols::anchorKindNamed(row[*anchor]);
            if (isSecond ? kind != protocols::AnchorKind::Repeated : kind.has_value()) continue;
            auto own = piecesIn(row[*pieces]);
            if (own.size() < 2) continue;
            std::ranges::sort(own);
            std::vector<std::string> presentation;
            for (const char* column : {"participant", "question", "fabric", "condition", "instruction"})
                if (const auto at = table.column(column)) presentation.push_back(row[*at]);
            if (!isSecond)
                first[presentation] = own;
            else if (const auto found = first.find(presentation); found != first.end() && found->second != own)
                anew.insert(row[*question]);
        }
    return anew;
}

class LongTable {
public:
    LongTable(const CsvTable& table, int alternatives)
        : m_table(table), m_alternatives(alternatives), m_isOwn(isExport(table)), m_keys(keyColumns.begin(), keyColumns.end())
    {
        if (namesAnchors(table)) m_keys.emplace_back(anchorColumn);
        m_trial = table.column(m_isOwn && table.column("place") ? "place" : "trial");
        m_namesCatches = m_isOwn && !table.column(repetitionColumn);
        chooseSeconds();
    }

    void writeInto(AnswerRows& rows)
    {
        for (const auto& numbers : {m_table.column("rating"), m_seconds})
            if (numbers) requireOneDecimalMark(m_table, *numbers);
        rows.times = m_times;
        findQuestions(rows);
        writeHeader(rows);
        findPlaces(rows);
        for (std::size_t row = 0; row < m_table.rows.size(); ++row) addAnswer(rows, row);
        for (const std::string& column : m_table.columns)
            if (std::ranges::find(m_keys, column) == m_keys.end() &&
                std::ranges::find(answerColumns, column) == answerColumns.end() &&
                !(m_isOwn && std::ranges::find(ownColumns, column) != ownColumns.end()))
                rows.unused.push_back(column);
    }

private:
    enum class Kind { Choice, Number, Words };

    /// Columns of one question in the wide table.
    struct Columns {
        Kind kind = Kind::Words;
        std::size_t first = 0;           ///< the parts of MadeColumn, in their order
        std::optional<int> pieces = {};  ///< on the tray of a choice; none where the table does not tell
    };

    std::string cell(std::size_t row, const char* column) const
    {
        const auto index = m_table.column(column);
        return index ? m_table.rows[row][*index] : std::string();
    }
    bool has(std::size_t row, const char* column) const
    {
        const auto index = m_table.column(column);
        return index && !protocols::isMissing(m_table.rows[row][*index]);
    }
    /// An own export is read by the rule of the study's report: times of two definitions must not meet in one table.
    void chooseSeconds()
    {
        m_seconds = m_table.column("seconds");
        const auto response = m_table.column("response_seconds");
        if (m_isOwn && response) {
            const bool allBegun = allPresent(*m_table.column("answer_begun_at"));
            m_times = allBegun ? TimesTaken::ToBeginning : TimesTaken::ToEntry;
            if (allBegun) m_seconds = response;
        } else if (response && allPresent(*response))
            m_seconds = response;
    }
    bool allPresent(std::size_t column) const
    {
        return std::ranges::none_of(m_table.rows, [&](const auto& row) { return protocols::isMissing(row[column]); });
    }

    /// The kind of a question: the most definite one that any of its rows shows.
    void findQuestions(AnswerRows& rows)
    {
        for (std::size_t row = 0; row < m_table.rows.size(); ++row) {
            const std::string id = cell(row, "question");
            if (protocols::isMissing(id))
                throw protocols::badInput(
                    {"the question is empty", protocols::rowName(m_table, row), "the name of a question", ""});
            if (!m_questions.contains(id)) addQuestion(id, row);
            Columns& columns = m_questions[id];
            if (has(row, "correct"))
                columns.kind = Kind::Choice;
            else if (has(row, "rating") && columns.kind == Kind::Words)
                columns.kind = Kind::Number;
        }
        if (m_isOwn) countAlternatives(rows);
        for (const std::string& id : m_order) {
            const Columns& columns = m_questions[id];
            rows.kinds.emplace(id, answerKindOf(columns));
            if (columns.kind == Kind::Choice && columns.pieces.value_or(0) == 0) rows.assumedChoices.insert(id);
        }
    }

    void addQuestion(const std::string& id, std::size_t row)
    {
        const std::size_t most = m_isOwn ? mostOwnQuestions : mostQuestions;
        if (m_order.size() == most)
            throw protocols::badInput({"the column \"question\" has more than " + std::to_string(most) +
                                           " different values, so it probably does not name the question",
                                       protocols::rowName(m_table, row),
                                       "at most " + std::to_string(most) + " questions, each in many rows",
                                       "name the right column by --map question=COLUMN"});
        m_order.push_back(id);
    }

    /// The tray of a choice holds its alternatives; that of same/different one piece.
    void countAlternatives(AnswerRows& rows)
    {
        for (std::size_t row = 0; row < m_table.rows.size(); ++row) {
            Columns& columns = m_questions.at(cell(row, "question"));
            if (columns.kind != Kind::Choice || !has(row, "correct")) continue;
            const auto pieces = static_cast<int>(piecesIn(cell(row, "alternatives")).size());
            if (columns.pieces && *columns.pieces != pieces) rows.mixedChoices.insert(cell(row, "question"));
            columns.pieces = pieces;
        }
    }

    protocols::AnswerKind answerKindOf(const Columns& columns) const
    {
        switch (columns.kind) {
            case Kind::Choice:
                if (columns.pieces == 1) return protocols::SameDifferent{};
                return protocols::ForcedChoice{columns.pieces.value_or(0) > 1 ? *columns.pieces : m_alternatives};
            case Kind::Number:
                return protocols::Rating{};
            case Kind::Words:
                return protocols::FreeText{};
        }
        return protocols::Rating{};
    }

    static const char* valueColumn(Kind kind)
    {
        return kind == Kind::Choice ? "correct" : kind == Kind::Number ? "rating" : "answer";
    }

    /// The names of made columns hold blanks: a question may be called like a column of the table.
    void writeHeader(AnswerRows& rows)
    {
        std::vector<std::string>& names = rows.table.columns;
        for (const std::string_view key : m_keys)
            if (m_table.column(key)) names.emplace_back(key);
        if (m_namesCatches) names.emplace_back(repetitionColumn);
        for (const std::string& id : m_order) {
            Columns& columns = m_questions[id];
            columns.first = names.size();
            int part = 0;
            std::vector<const char*> parts{valueColumn(columns.kind), "seconds", "answer", "trial", "sitting"};
            if (m_isOwn) parts.insert(parts.end(), {"slot", "touched_by", "entries", "late"});
            for (const char* name : parts) {
                rows.made[names.size()] = {id, static_cast<MadeColumn::Part>(part++)};
                names.push_back(std::string(name) + " of " + id);
            }
        }
    }

    bool isOfWithdrawn(std::size_t row) const { return m_isOwn && cell(row, "state") == "withdrawn"; }
    bool isVoided(std::size_t row) const
    {
        const std::string voided = cell(row, "voided");
        return !protocols::isMissing(voided) && voided != "0";
    }

    /// What the answers in one row of the wide table have in common.
    std::vector<std::string> keyOf(std::size_t row) const
    {
        std::vector<std::string> key;
        for (const std::string_view column : m_keys)
            if (const auto index = m_table.column(column)) key.push_back(m_table.rows[row][*index]);
        if (m_keys.back() == anchorColumn && m_trial && !protocols::isMissing(key.back()))
            key.back() += " " + m_table.rows[row][*m_trial];
        // Blank glass may come several times beside one fabric.
        if (m_namesCatches) key.push_back(cell(row, "condition") == protocols::catchTrialId().value ? cell(row, "trial") : "");
        return key;
    }

    /// Numbers the rows of the wide table before they take memory. Throws badInput where they would take too much.
    void findPlaces(const AnswerRows& rows)
    {
        for (std::size_t row = 0; row < m_table.rows.size(); ++row)
            if (!isOfWithdrawn(row) && !isVoided(row)) m_places.emplace(keyOf(row), m_places.size());
        const std::size_t columns = std::max<std::size_t>(rows.table.columns.size(), 1);  // a file may have no questions
        if (m_places.size() <= mostWideCells / columns) return;
        throw protocols::badInput({"the answers make a table of " + std::to_string(m_places.size()) + " rows and " +
                                       std::to_string(columns) + " columns (questions: " + std::to_string(m_order.size()) + ")",
                                   m_table.where, "at most " + std::to_string(mostWideCells) + " cells",
                                   "check the columns that --map names, or leave questions out of the file"});
    }

    void addAnswer(AnswerRows& rows, std::size_t row)
    {
        if (isOfWithdrawn(row)) {
            ++rows.ofWithdrawn;
            return;
        }
        if (isVoided(row)) {
            // An own export names the presentation, which may have several answers.
            const bool isNew =
                !m_isOwn || m_voided.insert({cell(row, "participant"), cell(row, "trial"), cell(row, "attempt")}).second;
            rows.voided += isNew ? 1 : 0;
            return;
        }
        const std::vector<std::string> key = keyOf(row);
        const auto place = m_places.find(key);
        if (place->second == rows.table.rows.size()) {
            rows.table.rows.push_back(key);
            rows.table.rows.back().resize(rows.table.columns.size());
            rows.table.lines.push_back(m_table.lines[row]);
        }
        const std::string id = cell(row, "question");
        if (!m_seen.insert({place->second, id}).second)
            throw protocols::badInput({"the answer to " + id + " occurs twice for one participant, fabric and condition",
                                       protocols::rowName(m_table, row),
                                       "one row an answer, or a column `repetition` or `session`",
                                       "name such a column by --map repetition=COLUMN"});
        const Columns& columns = m_questions.at(id);
        const auto put = [&](MadeColumn::Part part, const std::string& text) {
            rows.table.rows[place->second][columns.first + static_cast<std::size_t>(part)] = text;
        };
        put(MadeColumn::Part::Value, cell(row, valueColumn(columns.kind)));
        if (m_seconds) put(MadeColumn::Part::Seconds, m_table.rows[row][*m_seconds]);
        if (columns.kind == Kind::Choice) put(MadeColumn::Part::Answer, cell(row, "answer"));
        if (m_trial) put(MadeColumn::Part::Trial, m_table.rows[row][*m_trial]);
        put(MadeColumn::Part::Sitting, cell(row, "sitting"));
        if (!m_isOwn) return;
        put(MadeColumn::Part::Slot, slotOf(row, answerKindOf(columns)));
        put(MadeColumn::Part::TouchedBy, cell(row, "touched_by"));
        put(MadeColumn::Part::Entries, cell(row, "entries"));
        put(MadeColumn::Part::Late, cell(row, "late"));
    }

    /// The place of the answer among the alternatives, from 1; empty where it has none.
    std::string slotOf(std::size_t row, const protocols::AnswerKind& kind) const
    {
        std::vector<protocols::FabricId> tray;
        for (const std::string& piece : piecesIn(cell(row, "alternatives"))) tray.emplace_back(piece);
        const auto place = placeAmongAlternatives(kind, tray, cell(row, "answer"));
        return place ? std::to_string(*place + 1) : "";
    }

    const CsvTable& m_table;
    int m_alternatives;
    bool m_isOwn;                          ///< an export of this program
    std::vector<std::string_view> m_keys;  ///< columns that belong to the whole row
    std::optional<std::size_t> m_seconds, m_trial;
    TimesTaken m_times = TimesTaken::AsRecorded;
    std::set<std::tuple<std::string, std::string, std::string>> m_voided;
    bool m_namesCatches = false;  ///< by their trial, as repetitions
    std::map<std::string, Columns> m_questions;
    std::vector<std::string> m_order;
    std::map<std::vector<std::string>, std::size_t> m_places;
    std::set<std::pair<std::size_t, std::string>> m_seen;
};

/// "P01 " and "P01" are one participant, whom one blank would make two of.
void trimNames(CsvTable& table)
{
    std::vector<std::size_t> columns;
    for (const std::string_view name : keyColumns)
        if (const auto column = table.column(name)) columns.push_back(*column);
    for (const std::string_view name : {std::string_view("question"), std::string_view(anchorColumn)})
        if (const auto column = table.column(name)) columns.push_back(*column);
    for (auto& row : table.rows)
        for (const std::size_t column : columns)
            if (const auto name = nameWithoutBlanks(row[column]); name.size() != row[column].size())
                row[column] = std::string(name);
}

/// Right and wrong in words become 1 and 0.
void readWordsForRight(CsvTable& table)
{
    for (std::size_t column = 0; column < table.columns.size(); ++column)
        if (table.columns[column] == "correct" || table.columns[column].ends_with("_correct"))
            for (auto& row : table.rows) writeZeroOrOne(row[column]);
}

/// A table of one question may leave its name out.
void nameTheOnlyQuestion(CsvTable& table)
{
    if (table.column("question") || table.column("correct").has_value() == table.column("rating").has_value()) return;
    table.columns.emplace_back("question");
    for (auto& row : table.rows) row.emplace_back("Q1");
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
    for (const auto& [meaning, name] : options.names) rename(foreign.table, meaning, name);
    trimNames(foreign.table);
    readWordsForRight(foreign.table);
    AnswerRows rows;
    if (!foreign.isUsual) rows.taken = foreign.taken;
    rows.isOwnExport = isExport(foreign.table);
    nameTheOnlyQuestion(foreign.table);
    rows.hasAnchors = namesAnchors(foreign.table);
    if (rows.hasAnchors) rows.choicesRepeatedAnew = questionsRepeatedAnew(foreign.table);
    if (!foreign.table.column("question")) {
        rows.table = std::move(foreign.table);
        return rows;
    }
    rows.table.where = foreign.table.where;
    LongTable(foreign.table, alternatives).writeInto(rows);
    return rows;
}

}  // namespace reports
