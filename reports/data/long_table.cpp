#include "reports/data/long_table.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "protocols/condition.h"
#include "protocols/files/errors.h"
#include "protocols/files/utf8.h"
#include "protocols/protocol.h"
#include "reports/data/answer_numbers.h"
#include "reports/data/sitting_stamps.h"
#include "reports/data/table_marks.h"

namespace reports {

namespace {

using protocols::CsvTable;

/// Columns of a long table that belong to one answer.
constexpr std::array<std::string_view, 9> answerColumns{"question", "correct", "rating",           "answer", "seconds",
                                                        "trial",    "sitting", "response_seconds", "voided"};
/// Columns of an own export that say more about an answer.
constexpr std::array<std::string_view, 6> ownColumns{"place", "alternatives", "answer_begun_at", "touched_by", "entries", "late"};

/// Different questions that a long table of another lab may have. More are the sign of a column that holds something else.
constexpr std::size_t mostQuestions = 200;
/// Those of an own export are the questions of its protocol.
constexpr std::size_t mostOwnQuestions = 10'000;
/// Cells of the wide table. Each takes 32 bytes, and a small file can ask for very many.
constexpr std::size_t mostWideCells = 20'000'000;

constexpr const char* repetitionColumn = "repetition";

class LongTable {
public:
    LongTable(const CsvTable& table, int alternatives, AnswerRows& rows)
        : m_table(table),
          m_alternatives(alternatives),
          m_rows(rows),
          m_isOwn(rows.isOwnExport),
          m_keys(keyColumns.begin(), keyColumns.end())
    {
        if (namesAnchors(table)) m_keys.emplace_back(anchorColumn);
        m_trial = table.column(m_isOwn && table.column("place") ? "place" : "trial");
        m_namesCatches = m_isOwn && !table.column(repetitionColumn);
        m_keepsEmptyWords = m_isOwn && table.column("answer") && table.column("correct") && table.column("rating");
        m_rows.namesPresentations = m_isOwn && table.column("trial") && table.column("attempt");
        chooseSeconds();
    }

    void write()
    {
        for (const auto& numbers : {m_table.column("rating"), m_seconds})
            if (numbers) requireOneDecimalMark(m_table, *numbers);
        findQuestions();
        writeHeader();
        findPlaces();
        for (std::size_t row = 0; row < m_table.rows.size(); ++row) addAnswer(row);
        for (const std::string& column : m_table.columns)
            if (!isRead(column)) m_rows.unused.push_back(column);
    }

private:
    enum class Kind { Choice, Number, Words };

    /// Columns of one question in the wide table.
    struct Columns {
        bool hasChoices = false, hasRatings = false;
        std::size_t first = 0;           ///< the parts of MadeColumn, in their order
        std::optional<int> pieces = {};  ///< on the tray of a choice; none where the table does not tell

        Kind kind() const { return hasChoices ? Kind::Choice : hasRatings ? Kind::Number : Kind::Words; }
    };

    bool isRead(const std::string& column) const
    {
        const auto isIn = [&](const auto& columns) { return std::ranges::find(columns, column) != columns.end(); };
        return isIn(m_keys) || isIn(answerColumns) || (m_isOwn && isIn(ownColumns)) ||
               ((m_isOwn || m_rows.hasStates) && column == stateColumn) || (!m_rows.answeredBy.empty() && column == kindColumn);
    }

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
    /// Of two columns of times one counts, by the rule of the study's report: times of two definitions must not meet in one
    /// table.
    void chooseSeconds()
    {
        m_seconds = m_table.column("seconds");
        const auto response = m_table.column("response_seconds");
        if (!response) return;
        const TimesTaken times = m_seconds ? timesOfRows() : TimesTaken::ToBeginning;
        if (times == TimesTaken::ToBeginning) m_seconds = response;
        if (m_isOwn) m_rows.times = times;
    }

    /// A table without the stamps has a response time where an answer had them.
    TimesTaken timesOfRows() const
    {
        const char* stamp = m_isOwn && m_table.column("answer_begun_at") ? "answer_begun_at" : "response_seconds";
        SittingStamps stamps;
        for (std::size_t row = 0; row < m_table.rows.size(); ++row) {
            if (isOfWithdrawn(row) || isVoided(row)) continue;  // only answers that are analysed decide
            const bool isNumber = has(row, "correct") || has(row, "rating");
            stamps.add(cell(row, "participant"), cell(row, "sitting"),
                       isNumber ? SittingStamps::Content::Number : SittingStamps::Content::Words, has(row, stamp));
        }
        return stamps.times();
    }

    /// The kind of a question: the most definite one that any of its rows shows.
    void findQuestions()
    {
        for (std::size_t row = 0; row < m_table.rows.size(); ++row) {
            const std::string id = cell(row, "question");
            if (m_isOwn ? id.empty() : protocols::isMissing(id))
                throw protocols::badInput(
                    {"the question is empty", protocols::rowName(m_table, row), "the name of a question", ""});
            if (!m_questions.contains(id)) addQuestion(id, row);
            Columns& columns = m_questions[id];
            columns.hasChoices = columns.hasChoices || has(row, "correct");
            columns.hasRatings = columns.hasRatings || has(row, "rating");
            if (columns.hasChoices && columns.hasRatings) refuseBoth(id, row);
        }
        if (m_isOwn) countAlternatives();
        for (const std::string& id : m_order) {
            const Columns& columns = m_questions[id];
            m_rows.kinds.emplace(id, answerKindOf(columns));
            if (columns.kind() == Kind::Choice && columns.pieces.value_or(0) == 0) m_rows.assumedChoices.insert(id);
        }
    }

    /// One of the two would be lost.
    [[noreturn]] void refuseBoth(const std::string& id, std::size_t row) const
    {
        throw protocols::badInput({"the question " + protocols::inShort(id, 60) + " has both a choice (correct) and a rating",
                                   protocols::rowName(m_table, row), "one kind of answer for each question",
                                   "give the ratings another question id, in rows of their own"});
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

    /// Catch trials and anchors may have other trays than the list.
    bool isBesideTheList(std::size_t row) const
    {
        return (m_rows.hasAnchors && has(row, anchorColumn)) || cell(row, "condition") == protocols::catchTrialId().value;
    }

    /// The tray of a choice holds its alternatives; that of same/different one piece.
    void countAlternatives()
    {
        for (std::size_t row = 0; row < m_table.rows.size(); ++row) {
            Columns& columns = m_questions.at(cell(row, "question"));
            if (columns.kind() != Kind::Choice || !has(row, "correct") || isBesideTheList(row)) continue;
            const auto pieces = static_cast<int>(piecesIn(cell(row, "alternatives")).size());
            auto& trays = m_rows.trays[cell(row, "question")];
            if (!trays.contains(pieces)) trays.emplace(pieces, protocols::rowName(m_table, row));
            columns.pieces = pieces;
        }
    }

    protocols::AnswerKind answerKindOf(const Columns& columns) const
    {
        switch (columns.kind()) {
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
    void writeHeader()
    {
        std::vector<std::string>& names = m_rows.table.columns;
        for (const std::string_view key : m_keys)
            if (m_table.column(key)) names.emplace_back(key);
        if (m_namesCatches) names.emplace_back(repetitionColumn);
        for (const std::string& id : m_order) {
            Columns& columns = m_questions[id];
            columns.first = names.size();
            int part = 0;
            std::vector<const char*> parts{valueColumn(columns.kind()), "seconds", "answer", "trial", "sitting"};
            if (m_isOwn) parts.insert(parts.end(), {"slot", "touched_by", "entries", "late"});
            for (const char* name : parts) {
                m_rows.made[names.size()] = {id, static_cast<MadeColumn::Part>(part++)};
                names.push_back(std::string(name) + " of " + id);
            }
        }
    }

    bool isOfWithdrawn(std::size_t row) const { return (m_isOwn || m_rows.hasStates) && cell(row, stateColumn) == "withdrawn"; }
    bool isVoided(std::size_t row) const
    {
        const auto column = m_table.column("voided");
        return column && markAt(m_table, row, *column, {"voided", "valid"}).value_or(false);
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
    void findPlaces()
    {
        for (std::size_t row = 0; row < m_table.rows.size(); ++row)
            if (!isOfWithdrawn(row) && !isVoided(row)) m_places.emplace(keyOf(row), m_places.size());
        const std::size_t columns = std::max<std::size_t>(m_rows.table.columns.size(), 1);  // a file may have no questions
        if (m_places.size() <= mostWideCells / columns) return;
        throw protocols::badInput({"the answers make a table of " + std::to_string(m_places.size()) + " rows and " +
                                       std::to_string(columns) + " columns (questions: " + std::to_string(m_order.size()) + ")",
                                   m_table.where, "at most " + std::to_string(mostWideCells) + " cells",
                                   "check the columns that --map names, or leave questions out of the file"});
    }

    void addAnswer(std::size_t row)
    {
        if (isOfWithdrawn(row)) {
            ++m_rows.ofWithdrawn;
            return;
        }
        if (isVoided(row)) {
            // An own export names the presentation, which may have several answers, unless somebody took a column away.
            const bool isNew = !m_rows.namesPresentations ||
                               m_voided.insert({cell(row, "participant"), cell(row, "trial"), cell(row, "attempt")}).second;
            m_rows.voided += isNew ? 1 : 0;
            return;
        }
        const std::vector<std::string> key = keyOf(row);
        const auto place = m_places.find(key);
        if (place->second == m_rows.table.rows.size()) {
            m_rows.table.rows.push_back(key);
            m_rows.table.rows.back().resize(m_rows.table.columns.size());
            m_rows.table.lines.push_back(m_table.lines[row]);
        }
        const std::string id = cell(row, "question");
        if (!m_seen.insert({place->second, id}).second)
            throw protocols::badInput({"the answer to " + id + " occurs twice for one participant, fabric and condition",
                                       protocols::rowName(m_table, row),
                                       "one row an answer, or a column `repetition` or `session`",
                                       "name such a column by --map repetition=COLUMN"});
        const Columns& columns = m_questions.at(id);
        const auto put = [&](MadeColumn::Part part, const std::string& text) {
            m_rows.table.rows[place->second][columns.first + static_cast<std::size_t>(part)] = text;
        };
        noteWords(id, columns, row, place->second);
        put(MadeColumn::Part::Value, cell(row, valueColumn(columns.kind())));
        if (m_seconds) put(MadeColumn::Part::Seconds, m_table.rows[row][*m_seconds]);
        if (columns.kind() == Kind::Choice) put(MadeColumn::Part::Answer, cell(row, "answer"));
        if (m_trial) put(MadeColumn::Part::Trial, m_table.rows[row][*m_trial]);
        put(MadeColumn::Part::Sitting, cell(row, "sitting"));
        if (!m_isOwn) return;
        put(MadeColumn::Part::Slot, slotOf(row, answerKindOf(columns)));
        put(MadeColumn::Part::TouchedBy, cell(row, "touched_by"));
        put(MadeColumn::Part::Entries, cell(row, "entries"));
        put(MadeColumn::Part::Late, cell(row, "late"));
    }

    /// In an own export a row is an answer, also where its words are empty or NA. In other rows words alone are not analysed.
    void noteWords(const std::string& id, const Columns& columns, std::size_t row, std::size_t place)
    {
        if (columns.kind() != Kind::Words) {
            const bool isWithoutValue = !has(row, valueColumn(columns.kind()));
            m_rows.wordsAlone += isWithoutValue && has(row, "answer") ? 1 : 0;
            return;
        }
        if (!m_keepsEmptyWords) return;
        std::vector<bool>& given = m_rows.given[id];
        if (given.size() <= place) given.resize(place + 1);
        given[place] = true;
    }

    /// The place of the answer among the alternatives, from 1; empty where it has none.
    std::string slotOf(std::size_t row, const protocols::AnswerKind& kind) const
    {
        const bool isFabric = std::holds_alternative<protocols::ForcedChoice>(kind);  // which may be called NA
        if (!isFabric && !has(row, "answer")) return "";
        std::vector<protocols::FabricId> tray;
        for (const std::string& piece : piecesIn(cell(row, "alternatives"))) tray.emplace_back(piece);
        const auto place = placeAmongAlternatives(kind, tray, cell(row, "answer"));
        return place ? std::to_string(*place + 1) : "";
    }

    const CsvTable& m_table;
    int m_alternatives;
    AnswerRows& m_rows;
    bool m_isOwn;                          ///< an export of this program
    std::vector<std::string_view> m_keys;  ///< columns that belong to the whole row
    std::optional<std::size_t> m_seconds, m_trial;
    std::set<std::tuple<std::string, std::string, std::string>> m_voided;
    bool m_namesCatches = false;     ///< by their trial, as repetitions
    bool m_keepsEmptyWords = false;  ///< every row of a question in words is an answer
    std::map<std::string, Columns> m_questions;
    std::vector<std::string> m_order;
    std::map<std::vector<std::string>, std::size_t> m_places;
    std::set<std::pair<std::size_t, std::string>> m_seen;
};

}  // namespace

void writeWideTable(const CsvTable& table, int alternatives, AnswerRows& rows) { LongTable(table, alternatives, rows).write(); }

}  // namespace reports
