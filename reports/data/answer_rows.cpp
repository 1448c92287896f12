#include "reports/data/answer_rows.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <tuple>

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

/// Columns that only this program's export has together, also a public one, which has no times of day.
bool isExport(const CsvTable& table)
{
    return table.column("answer_begun_at") && table.column("stored_at") && table.column("alternatives") &&
           table.column("touched_by") && table.column("corrections");
}

constexpr const char* anchorColumn = "anchor";

/// Whether the table has such a column, and it holds only kinds of anchors.
bool namesAnchors(const CsvTable& table)
{
    const auto column = table.column(anchorColumn);
    return column && std::ranges::all_of(table.rows, [&](const auto& row) {
               return protocols::isMissing(row[*column]) || protocols::anchorKindNamed(row[*column]);
           });
}

/// The pieces in a list as an export writes it, sorted: ["F02","F01"]. Ids hold no commas.
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
    std::ranges::sort(pieces);
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
            const auto own = piecesIn(row[*pieces]);
            if (own.size() < 2) continue;
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
        : m_table(table), m_alternatives(alternatives), m_keys(keyColumns.begin(), keyColumns.end())
    {
        if (namesAnchors(table)) m_keys.emplace_back(anchorColumn);
        m_seconds = table.column("seconds");
        const auto response = table.column("response_seconds");
        if (response && allPresent(*response)) m_seconds = response;
        m_trial = table.column(isExport(table) && table.column("place") ? "place" : "trial");
    }

    void writeInto(AnswerRows& rows)
    {
        for (const auto& numbers : {m_table.column("rating"), m_seconds})
            if (numbers) requireOneDecimalMark(m_table, *numbers);
        findQuestions(rows);
        writeHeader(rows.table);
        for (std::size_t row = 0; row < m_table.rows.size(); ++row) addAnswer(rows, row);
        for (const std::string& column : m_table.columns)
            if (std::ranges::find(m_keys, column) == m_keys.end() &&
                std::ranges::find(answerColumns, column) == answerColumns.end() && column != "place")
                rows.unused.push_back(column);
    }

private:
    enum class Kind { Choice, Number, Words };

    /// Columns of one question in the wide table.
    struct Columns {
        Kind kind = Kind::Words;
        std::size_t first = 0;  ///< value, seconds, answer, trial, sitting
    };
    static constexpr std::size_t columnsOfQuestion = 5;

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
            if (!m_questions.contains(id)) m_order.push_back(id);
            Columns& columns = m_questions[id];
            if (has(row, "correct"))
                columns.kind = Kind::Choice;
            else if (has(row, "rating") && columns.kind == Kind::Words)
                columns.kind = Kind::Number;
        }
        for (const std::string& id : m_order) rows.kinds.emplace(id, answerKindOf(m_questions[id].kind));
    }

    protocols::AnswerKind answerKindOf(Kind kind) const
    {
        switch (kind) {
            case Kind::Choice:
                return protocols::ForcedChoice{m_alternatives};
            case Kind::Number:
                return protocols::Rating{};
            case Kind::Words:
                return protocols::FreeText{};
        }
        return protocols::Rating{};
    }

    void writeHeader(CsvTable& wide)
    {
        for (const std::string_view key : m_keys)
            if (m_table.column(key)) wide.columns.emplace_back(key);
        for (const std::string& id : m_order) {
            Columns& columns = m_questions[id];
            columns.first = wide.columns.size();
            wide.columns.push_back(columns.kind == Kind::Choice ? id + "_correct" : id);
            for (const char* suffix : {"_seconds", "_answer", "_trial", "_sitting"}) wide.columns.push_back(id + suffix);
        }
    }

    void addAnswer(AnswerRows& rows, std::size_t row)
    {
        if (const std::string voided = cell(row, "voided"); !protocols::isMissing(voided) && voided != "0") {
            ++rows.voided;
            return;
        }
        std::vector<std::string> key;
        for (const std::string_view column : m_keys)
            if (const auto index = m_table.column(column)) key.push_back(m_table.rows[row][*index]);
        if (m_keys.back() == anchorColumn && m_trial && !protocols::isMissing(key.back()))
            key.back() += " " + m_table.rows[row][*m_trial];
        const auto [place, isNew] = m_places.emplace(key, rows.table.rows.size());
        if (isNew) {
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
        std::string* out = &rows.table.rows[place->second][columns.first];
        const char* value = columns.kind == Kind::Choice ? "correct" : columns.kind == Kind::Number ? "rating" : "answer";
        out[0] = cell(row, value);
        if (m_seconds) out[1] = m_table.rows[row][*m_seconds];
        if (columns.kind == Kind::Choice) out[2] = cell(row, "answer");
        if (m_trial) out[3] = m_table.rows[row][*m_trial];
        out[4] = cell(row, "sitting");
        static_assert(columnsOfQuestion == 5);
    }

    const CsvTable& m_table;
    int m_alternatives;
    std::vector<std::string_view> m_keys;  ///< columns that belong to the whole row
    std::optional<std::size_t> m_seconds, m_trial;
    std::map<std::string, Columns> m_questions;
    std::vector<std::string> m_order;
    std::map<std::vector<std::string>, std::size_t> m_places;
    std::set<std::pair<std::size_t, std::string>> m_seen;
};

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
