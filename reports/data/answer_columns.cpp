#include "reports/data/answer_columns.h"

#include <algorithm>
#include <map>
#include <string_view>
#include <utility>

#include "protocols/files/errors.h"
#include "protocols/question_ids.h"
#include "reports/data/table_marks.h"
#include "reports/text/plain_words.h"

namespace reports {
namespace {

bool isDigit(char c) { return c >= '0' && c <= '9'; }

/// "Q2" and the like need no protocol to be known as questions.
bool isUsualName(const std::string& name)
{
    return name.size() >= 2 && name[0] == 'Q' && std::all_of(name.begin() + 1, name.end(), isDigit);
}

/// "Q1_seconds" -> "Q1" for the suffix "_seconds".
std::optional<std::string> stem(const std::string& name, const std::string& suffix)
{
    if (name.size() <= suffix.size() || !name.ends_with(suffix)) return std::nullopt;
    return name.substr(0, name.size() - suffix.size());
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
            const auto kind = m_rows.kinds.at(made.question);
            const bool isScored = std::holds_alternative<RightOrWrong>(scoringOf(kind));
            return setValueColumn(made.question, index, isScored ? choiceKind(made.question) : openKind(made.question));
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
            setValueColumn(*id, index, choiceKind(*id));
        else if (const auto timed = stem(name, "_seconds"))
            question(*timed).time = index;
        else if (const auto answered = stem(name, "_answer"))
            question(*answered).answer = index;
        else if (isUsualName(name) || inProtocol(name) != nullptr)
            setValueColumn(name, index, openKind(name));
        else if (const std::size_t end = name.find('_'); end != std::string::npos && isUsualName(name.substr(0, end)))
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
    }

    /// Whether neither caller nor protocol nor export states the number of alternatives.
    bool isAssumed(const std::string& id, const protocols::AnswerKind& kind) const
    {
        const protocols::Question* asked = inProtocol(id);
        const bool isInProtocol = asked != nullptr && asked->kind == kind;
        const bool isInFile = m_rows.kinds.contains(id) && !m_rows.assumedChoices.contains(id);
        return std::holds_alternative<protocols::ForcedChoice>(kind) && !m_options.alternatives && !isInProtocol && !isInFile;
    }

    /// The protocol's kind, where its answers are right or wrong.
    protocols::AnswerKind choiceKind(const std::string& id) const
    {
        const protocols::Question* asked = inProtocol(id);
        if (asked != nullptr && std::holds_alternative<RightOrWrong>(scoringOf(asked->kind))) return asked->kind;
        if (m_rows.mixedChoices.contains(id))
            fail("the choices of " + id + " have several numbers of alternatives", m_place, "the protocol of the study",
                 "name it by --protocol FILE; it lies in the study's folder");
        const auto found = m_rows.kinds.find(id);
        const bool isScored = found != m_rows.kinds.end() && std::holds_alternative<RightOrWrong>(scoringOf(found->second));
        return isScored ? found->second
                        : protocols::AnswerKind(protocols::ForcedChoice{m_options.alternatives.value_or(usualAlternatives)});
    }

    /// The protocol's kind, where its answers are numbers or words.
    protocols::AnswerKind openKind(const std::string& id) const
    {
        const protocols::Question* asked = inProtocol(id);
        if (asked != nullptr && !std::holds_alternative<RightOrWrong>(scoringOf(asked->kind))) return asked->kind;
        if (const auto found = m_rows.kinds.find(id);
            found != m_rows.kinds.end() && !std::holds_alternative<protocols::Rating>(found->second))
            return found->second;
        return m_options.scale ? protocols::Rating{*m_options.scale} : protocols::Rating{};
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

}  // namespace reports
