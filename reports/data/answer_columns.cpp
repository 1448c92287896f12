#include "reports/data/answer_columns.h"

#include <algorithm>
#include <map>
#include <string_view>
#include <utility>

#include "protocols/files/errors.h"
#include "protocols/files/number_text.h"
#include "protocols/question_ids.h"
#include "reports/data/table_marks.h"
#include "reports/text/plain_words.h"

namespace reports {
namespace {

/// "Q1_seconds" -> "Q1" for the suffix "_seconds".
std::optional<std::string> stem(const std::string& name, const std::string& suffix)
{
    if (name.size() <= suffix.size() || !name.ends_with(suffix)) return std::nullopt;
    return name.substr(0, name.size() - suffix.size());
}

/// "0 to 10".
std::string endsOf(const protocols::RatingScale& scale)
{
    return protocols::shortest(scale.min.inScaleUnits()) + " to " + protocols::shortest(scale.max.inScaleUnits());
}

/// What a protocol asks for, in the words of messages.
std::string inWords(const protocols::AnswerKind& kind)
{
    return std::visit(
        protocols::Overloaded{
            [](const protocols::ForcedChoice& choice) { return "a choice among " + std::to_string(choice.alternatives); },
            [](const protocols::Rating& rating) { return "a rating from " + endsOf(rating.scale); },
            [](const protocols::SameDifferent&) { return std::string("same or different"); },
            [](const protocols::FreeText&) { return std::string("answered in words"); }},
        kind);
}

/// Columns that say where an answer belongs; the others are questions.
constexpr std::string_view designColumns[] = {"participant", "fabric", "condition", "group", "session", "repetition"};

class HeaderOfAnswers {
public:
    HeaderOfAnswers(const AnswerRows& rows, const AnswersCsvOptions& options, const std::string& where)
        : m_rows(rows), m_options(options), m_place(where + ", header row")
    {
    }

    AnswerColumns read()
    {
        for (const char* needed : {"participant", "fabric", "condition"})
            if (!m_table.column(needed))
                fail("the column \"" + std::string(needed) + "\" is missing", m_place,
                     "participant,fabric,condition and the questions, such as Q1_correct,Q2,Q3,Q4",
                     "where the column has another name, give it by --map " + std::string(needed) + "=COLUMN");
        for (std::size_t i = 0; i < m_table.columns.size(); ++i) readColumn(m_table.columns[i], i);
        for (const QuestionColumns& known : m_columns.questions)
            if (!known.value)
                fail("the question " + known.info.id + " has no answers", m_place,
                     "a column " + known.info.id + "_correct or " + known.info.id);
        if (m_columns.questions.empty())
            fail("there is no question", m_place, "columns such as Q1_correct,Q2,Q3,Q4",
                 "where a question has another name, give it by --map Q1_correct=COLUMN or --map Q2=COLUMN");
        std::stable_sort(m_columns.questions.begin(), m_columns.questions.end(),
                         [](const auto& a, const auto& b) { return a.value < b.value; });
        requireUseOfScale();
        return std::move(m_columns);
    }

private:
    [[noreturn]] static void fail(const std::string& what, const std::string& place, const std::string& expected,
                                  const std::string& nextStep = {})
    {
        throw protocols::badInput({what, place, expected, nextStep});
    }

    const protocols::Question* inProtocol(const std::string& id) const
    {
        return m_options.protocol ? protocols::questionWith(*m_options.protocol, protocols::QuestionId(id)) : nullptr;
    }

    /// Those of the question's phase; none where no protocol is given.
    std::vector<InstructionInfo> instructionsInProtocol(const std::string& id) const
    {
        std::vector<InstructionInfo> instructions;
        if (!m_options.protocol) return instructions;
        for (const protocols::Phase& phase : m_options.protocol->phases) {
            if (std::ranges::find(phase.questions, protocols::QuestionId(id), &protocols::Question::id) == phase.questions.end())
                continue;
            for (const protocols::BlockInstruction& one : phase.instructions)
                instructions.push_back({one.id.value, one.text, one.deadlineSeconds});
        }
        return instructions;
    }

    /// The question of a column; its kind is settled by its first column with answers.
    QuestionColumns& question(const std::string& id)
    {
        if (const auto known = m_places.find(id); known != m_places.end()) return m_columns.questions[known->second];
        requireGoodId(id);
        m_places.emplace(id, m_columns.questions.size());
        const protocols::Question* asked = inProtocol(id);
        m_columns.questions.push_back({{id, asked != nullptr ? asked->text : std::string(), {}}});
        m_columns.questions.back().info.instructions = instructionsInProtocol(id);
        return m_columns.questions.back();
    }

    void requireGoodId(const std::string& id)
    {
        if (!protocols::isQuestionId(id))
            fail("the question \"" + id + "\" has a name that files cannot carry", m_place,
                 "a letter, then letters, digits and underscores, at most 40 characters");
        if (const auto [known, isNew] = m_inLowerCase.emplace(lowerCase(id), id); !isNew)
            fail("the questions " + known->second + " and " + id + " differ in case only", m_place, "different names");
    }

    /// A column whose question is known already, whatever it is called.
    void takeMade(const MadeColumn& made, std::size_t index)
    {
        using Part = MadeColumn::Part;
        if (made.part == Part::Value) {
            const bool isChoice = isScored(m_rows.kinds.at(made.question));
            return setValueColumn(made.question, index,
                                  isChoice ? choiceKind(made.question, index) : openKind(made.question, index));
        }
        QuestionColumns& columns = question(made.question);
        const std::pair<Part, std::optional<std::size_t> QuestionColumns::*> parts[] = {
            {Part::Seconds, &QuestionColumns::time},    {Part::Answer, &QuestionColumns::answer},
            {Part::Trial, &QuestionColumns::trial},     {Part::Sitting, &QuestionColumns::sitting},
            {Part::Slot, &QuestionColumns::slot},       {Part::TouchedBy, &QuestionColumns::touchedBy},
            {Part::Entries, &QuestionColumns::entries}, {Part::Late, &QuestionColumns::late}};
        for (const auto& [part, column] : parts)
            if (part == made.part) columns.*column = index;
    }

    void readColumn(const std::string& name, std::size_t index)
    {
        if (const auto made = m_rows.made.find(index); made != m_rows.made.end()) return takeMade(made->second, index);
        if (std::ranges::find(designColumns, name) != std::end(designColumns)) return;
        if ((inProtocol(name) == nullptr || !m_rows.made.empty()) && isPlaceColumn(name, index)) return;
        if (const auto id = stem(name, "_correct"))
            setValueColumn(*id, index, choiceKind(*id, index));
        else if (const auto timed = stem(name, "_seconds"))
            question(*timed).time = index;
        else if (const auto answered = stem(name, "_answer"))
            question(*answered).answer = index;
        else if (isUsualQuestion(name) || inProtocol(name) != nullptr)
            setValueColumn(name, index, openKind(name, index));
        else if (const std::size_t end = name.find('_'); end != std::string::npos && isUsualQuestion(name.substr(0, end)))
            fail("the column \"" + name + "\" is unknown", m_place,
                 "a question such as " + name.substr(0, end) + ", alone or with _correct, _seconds, _answer, _trial or _sitting");
        else if (!isOfExport(name))
            m_columns.unused.push_back(name.empty() ? "a column without a name" : name);
    }

    /// Columns that readAnswerRows() has used.
    bool isOfExport(const std::string& name) const
    {
        return (name == stateColumn && m_rows.hasStates) || (name == kindColumn && !m_rows.answeredBy.empty());
    }

    /// "trial", "sitting", "instruction" and "anchor" hold for every question of the row, "Q1_trial" and "Q1_sitting" for one.
    bool isPlaceColumn(const std::string& name, std::size_t index)
    {
        if (name == "trial")
            m_columns.trial = index;
        else if (name == "sitting")
            m_columns.sitting = index;
        else if (name == "instruction")
            m_columns.instruction = index;
        else if (name == "anchor" && m_rows.hasAnchors)
            m_columns.anchor = index;
        else if (const auto shown = stem(name, "_trial"))
            question(*shown).trial = index;
        else if (const auto sat = stem(name, "_sitting"))
            question(*sat).sitting = index;
        else
            return false;
        return true;
    }

    void setValueColumn(const std::string& id, std::size_t index, const protocols::AnswerKind& kind)
    {
        QuestionColumns& columns = question(id);
        if (columns.value) fail("the question " + id + " has two columns", m_place, "either " + id + " or " + id + "_correct");
        columns.value = index;
        columns.info.kind = kind;
        columns.info.alternativesAssumed = isAssumed(id, kind);
        columns.info.scaleAssumed =
            std::holds_alternative<protocols::Rating>(kind) && !m_options.scale && inProtocol(id) == nullptr;
    }

    /// Whether neither caller nor protocol nor export states the number of alternatives.
    bool isAssumed(const std::string& id, const protocols::AnswerKind& kind) const
    {
        const protocols::Question* asked = inProtocol(id);
        const bool isInProtocol = asked != nullptr && asked->kind == kind;
        const bool isInFile = m_rows.kinds.contains(id) && !m_rows.assumedChoices.contains(id);
        return std::holds_alternative<protocols::ForcedChoice>(kind) && !m_options.alternatives && !isInProtocol && !isInFile;
    }

    /// Whether the column holds answers. In an own export empty words are answers, too.
    bool holdsAnswers(const std::string& id, std::size_t index) const
    {
        return m_rows.given.contains(id) ||
               std::ranges::any_of(m_table.rows, [&](const auto& row) { return !protocols::isMissing(row[index]); });
    }

    static bool isScored(const protocols::AnswerKind& kind) { return std::holds_alternative<RightOrWrong>(scoringOf(kind)); }

    /// Of a column that holds answers of another kind than the protocol asks for.
    [[noreturn]] void refuseKind(const protocols::Question& asked, std::size_t index, const std::string& held) const
    {
        const std::string& id = asked.id.value;
        const bool isWide = !m_rows.made.contains(index), wantsScores = isScored(asked.kind);
        const std::string column = wantsScores ? "correct" : "rating";
        const std::string wanted = wantsScores ? (isWide ? id + "_correct" : column) : (isWide ? id : column);
        fail("the column \"" + m_table.columns[index] + "\" holds " + held + ", but by the protocol " + id + " is " +
                 inWords(asked.kind),
             m_place, "answers that the protocol asks for",
             m_table.column(wanted) || std::holds_alternative<protocols::FreeText>(asked.kind)
                 ? "name the protocol of these answers by --protocol, or leave the column out"
                 : "name the protocol of these answers by --protocol, or the right column by --map " + wanted + "=COLUMN");
    }

    /// The trays of an export tell the alternatives, so a protocol with others belongs to other answers.
    void requireTraysOf(const protocols::Question& asked) const
    {
        const auto found = m_rows.trays.find(asked.id.value);
        if (found == m_rows.trays.end()) return;
        const int expected = protocols::piecesOnTray(asked.kind);
        for (const auto& [pieces, row] : found->second)
            if (pieces != 0 && pieces != expected)
                fail("the tray of " + asked.id.value + " has " + counted(static_cast<std::size_t>(pieces), "piece") +
                         ", but by the protocol " + asked.id.value + " is " + inWords(asked.kind),
                     row + ", column alternatives", "a tray of " + counted(static_cast<std::size_t>(expected), "piece"),
                     "name the protocol of these answers by --protocol, or leave it out: the trays tell the alternatives");
    }

    void requireOneNumberOfPieces(const std::string& id) const
    {
        const auto found = m_rows.trays.find(id);
        if (found == m_rows.trays.end() || found->second.size() < 2) return;
        const bool someAreUnknown = found->second.size() == 2 && found->second.contains(0);
        fail("the choices of " + id + " have several numbers of alternatives", m_place,
             someAreUnknown ? "a tray in each row, or the protocol of the study" : "the answers of one study",
             someAreUnknown ? "name the protocol by --protocol FILE; it lies in the study's folder"
                            : "report on each number of alternatives from a file of its own");
    }

    /// Of a column of right and wrong answers: the protocol's kind, or what the file tells.
    protocols::AnswerKind choiceKind(const std::string& id, std::size_t index) const
    {
        if (const protocols::Question* asked = inProtocol(id)) {
            if (!isScored(asked->kind) && holdsAnswers(id, index)) refuseKind(*asked, index, "answers that are right or wrong");
            requireTraysOf(*asked);
            return asked->kind;
        }
        requireOneNumberOfPieces(id);
        const auto found = m_rows.kinds.find(id);
        return found != m_rows.kinds.end() && isScored(found->second)
                   ? found->second
                   : protocols::AnswerKind(protocols::ForcedChoice{m_options.alternatives.value_or(usualAlternatives)});
    }

    /// Of a column of numbers or words: the protocol's kind, or what the file tells.
    protocols::AnswerKind openKind(const std::string& id, std::size_t index) const
    {
        const auto found = m_rows.kinds.find(id);
        const bool isLong = found != m_rows.kinds.end();
        const bool isRated = isLong && std::holds_alternative<protocols::Rating>(found->second);
        if (const protocols::Question* asked = inProtocol(id)) {
            requireOpenKind(*asked, index, isRated ? "ratings" : isLong ? "words" : "ratings or words");
            return asked->kind;
        }
        if (isLong && !isRated) return found->second;
        return m_options.scale ? protocols::Rating{*m_options.scale} : protocols::Rating{};
    }

    /// A wide column, and words of another lab's long table, may be ratings or words. An export tells which of them it has.
    void requireOpenKind(const protocols::Question& asked, std::size_t index, const std::string& held) const
    {
        const bool wantsWords = std::holds_alternative<protocols::FreeText>(asked.kind);
        const bool differs =
            isScored(asked.kind) || (wantsWords && held == "ratings") || (!wantsWords && m_rows.given.contains(asked.id.value));
        if (differs && holdsAnswers(asked.id.value, index)) refuseKind(asked, index, held);
    }

    /// Where the protocol describes all ratings, the scale that the caller names would be ignored in silence.
    void requireUseOfScale() const
    {
        if (!m_options.scale) return;
        const QuestionColumns* other = nullptr;  // rated on another scale
        for (const QuestionColumns& columns : m_columns.questions) {
            const auto* rating = std::get_if<protocols::Rating>(&columns.info.kind);
            if (rating == nullptr) continue;
            if (inProtocol(columns.info.id) == nullptr) return;
            const bool isSame = rating->scale.min == m_options.scale->min && rating->scale.max == m_options.scale->max;
            if (!isSame && other == nullptr) other = &columns;
        }
        if (other == nullptr) return;
        fail("--scale names " + endsOf(*m_options.scale) + ", but by the protocol " + other->info.id + " is rated from " +
                 endsOf(std::get<protocols::Rating>(other->info.kind).scale),
             "--scale and --protocol", "ratings that the protocol does not describe, or its own scale",
             "leave --scale out, or correct the scale in the protocol");
    }

    const AnswerRows& m_rows;
    const protocols::CsvTable& m_table = m_rows.table;
    const AnswersCsvOptions& m_options;
    std::string m_place;
    AnswerColumns m_columns;
    std::map<std::string, std::size_t> m_places;       ///< of the questions by their ids
    std::map<std::string, std::string> m_inLowerCase;  ///< their ids
};

}  // namespace

AnswerColumns answerColumnsOf(const AnswerRows& rows, const AnswersCsvOptions& options, const std::string& where)
{
    return HeaderOfAnswers(rows, options, where).read();
}

bool isRatedOnScaleOf(const protocols::Protocol& protocol, const AnswerColumns& columns)
{
    if (memorisedScaleOf(protocol) == nullptr) return false;
    bool hasOthers = false;
    for (const QuestionColumns& one : columns.questions) {
        if (!std::holds_alternative<NumberOnScale>(scoringOf(one.info.kind))) continue;
        if (questionWith(protocol, protocols::QuestionId(one.info.id)) != nullptr) return true;
        hasOthers = true;
    }
    return !hasOthers;
}

}  // namespace reports
