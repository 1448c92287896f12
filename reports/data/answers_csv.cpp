#include "reports/data/answers_csv.h"

#include <algorithm>
#include <map>
#include <set>
#include <string_view>
#include <tuple>

#include "protocols/condition.h"
#include "protocols/files/csv_table.h"
#include "protocols/files/errors.h"
#include "protocols/files/number_text.h"
#include "protocols/files/utf8.h"
#include "reports/data/answer_columns.h"
#include "reports/data/answer_notes.h"
#include "reports/data/answer_numbers.h"
#include "reports/text/plain_words.h"

namespace reports {
namespace {

using protocols::AnchorKind;

/// Under this name JSON files give the reasons of missing numbers.
constexpr const char* reservedName = "why";

class AnswersReader {
public:
    AnswersReader(const std::filesystem::path& file, const AnswersCsvOptions& options)
        : m_where(file.string()),
          m_options(options),
          m_rows(readAnswerRows(file, options.rows, options.alternatives.value_or(usualAlternatives)))
    {
        m_data.name = file.stem().string();
        m_data.blinded = false;
        m_data.protocolSha256 = options.protocolSha256;
        for (const auto& [a, b] : options.planned) m_planned.emplace_back(conditionOf(a), conditionOf(b));
    }

    StudyData read()
    {
        m_columns = answerColumnsOf(m_rows, m_options, m_where);
        readProtocol();
        readStatedOptions();
        rememberFabricsOfAnswers();
        for (const QuestionColumns& columns : m_columns.questions)
            for (const InstructionInfo& given : columns.info.instructions) m_instructions[columns.info.id].insert(given.id);
        for (std::size_t row = 0; row < m_table.rows.size(); ++row) readRow(row);
        for (const auto& [question, scores] : m_found.scores) scores.requireRightAsOne(m_table);
        for (QuestionColumns& known : m_columns.questions) {
            if (!m_columns.instruction) known.info.instructions.clear();
            m_data.questions.push_back(known.info);
        }
        if (m_data.responses.empty()) fail("there are no answers", m_where, "at least one row with an answer");
        countAnswersOfCells();
        m_data.times = m_rows.times;
        m_data.simulated = m_rows.answeredBy.contains("simulated");
        m_data.scripted = m_rows.answeredBy.contains("scripted");
        m_data.knowsKinds = !m_rows.answeredBy.empty();
        m_data.voided = m_rows.voided;
        m_data.choicesRepeatedAnew = m_rows.choicesRepeatedAnew;
        putInOrder();
        requireKnownContrasts();
        if (m_options.note)
            for (const std::string& note : answerNotes(m_rows, m_columns, m_data, m_found, m_where)) m_options.note(note);
        return std::move(m_data);
    }

private:
    [[noreturn]] void fail(const std::string& what, const std::string& place, const std::string& expected,
                           const std::string& nextStep = {}) const
    {
        throw protocols::badInput({what, place, expected, nextStep});
    }

    std::string nameOf(std::size_t row) const { return protocols::rowName(m_table, row); }
    const std::string& cell(std::size_t row, std::size_t column) const { return m_table.rows[row][column]; }

    /// The usual bounds are those of the ratings that the protocol describes, or else of the scale that the caller names.
    void readBounds()
    {
        const auto& protocol = m_options.protocol;
        if (protocol) m_data.equivalenceBounds = protocol->equivalenceBounds;
        if (protocol && !protocol->hasUsualBounds) m_data.boundsFrom = PlanOrigin::Protocol;
        if (m_data.boundsFrom == PlanOrigin::Program && m_options.scale && !(protocol && isRatedOnScaleOf(*protocol, m_columns)))
            m_data.equivalenceBounds = protocols::usualBoundsOn(*m_options.scale);
    }

    void readProtocol()
    {
        readBounds();
        if (!m_options.protocol) return;
        m_data.name = m_options.protocol->name;
        for (const protocols::PlannedContrast& contrast : contrastsInOrder(*m_options.protocol))
            m_data.planned.emplace_back(contrast.a.value, contrast.b.value);
        readDesign(*m_options.protocol);
    }

    /// What the caller states wins over the protocol.
    void readStatedOptions()
    {
        if (m_options.equivalenceBounds) {
            m_data.equivalenceBounds = *m_options.equivalenceBounds;
            m_data.boundsFrom = PlanOrigin::Option;
        }
        if (m_planned.empty()) return;
        m_data.planned = m_planned;
        m_data.plannedFrom = PlanOrigin::Option;
    }

    /// The rows of an export stand in the order of time, which differs from study to study. So the conditions of the protocol, or
    /// of the paper, get their own order.
    void putInOrder()
    {
        if (!m_rows.isOwnExport) return;
        std::vector<std::string> order;
        if (m_options.protocol)
            for (const auto& condition : m_options.protocol->conditions) order.push_back(condition.value);
        else
            for (const auto& condition : protocols::allConditions()) order.emplace_back(condition.id);
        const auto placeIn = [&](const std::string& name) { return std::ranges::find(order, name) - order.begin(); };
        std::ranges::stable_sort(m_data.conditions, {}, placeIn);
        std::ranges::sort(m_data.fabrics);
    }

    void requireKnownContrasts() const
    {
        for (const auto& [a, b] : m_planned)
            for (const std::string& name : {a, b})
                if (std::ranges::find(m_data.conditions, name) == m_data.conditions.end())
                    fail("the planned contrast names \"" + name + "\", which is no condition of the answers", m_where,
                         listed(m_data.conditions));
        requireDifferentContrasts();
    }

    /// A contrast that comes twice would count twice in Holm's correction; one of a condition with itself is 0.
    void requireDifferentContrasts() const
    {
        std::set<std::pair<std::string, std::string>> seen;
        for (const auto& [a, b] : m_planned) {
            const std::string named = "the planned contrast \"" + a + "," + b + "\" ";
            if (a == b) fail(named + "compares a condition with itself", m_where, "two conditions", "correct this --planned");
            if (!seen.insert(std::minmax(a, b)).second)
                fail(named + "repeats an earlier one", m_where, "each pair of conditions once, in one order",
                     "leave out one of the two --planned");
        }
    }

    void readDesign(const protocols::Protocol& protocol)
    {
        PlannedDesign& design = m_data.plannedDesign.emplace();
        design.participants = static_cast<std::size_t>(protocol.participants);
        design.fabrics = static_cast<std::size_t>(protocol.fabricCount);
        for (const auto& fabric : protocol.fabrics) design.fabricIds.push_back(fabric.value);
        for (const auto& condition : protocol.conditions) design.conditionIds.push_back(condition.value);
        design.conditions = design.conditionIds.size();
        for (const auto& phase : protocol.phases)
            for (const auto& asked : phase.questions) design.questions.push_back(asked.id.value);
        design.contrastPairs = m_data.planned;
        design.contrasts = m_data.planned.size();
        design.equivalenceBounds = m_data.equivalenceBounds;
        design.hasUsualBounds = protocol.hasUsualBounds;
        design.answersPerRendering = static_cast<std::size_t>(protocol.answersPerRendering());
        design.protocolSha256 = m_data.protocolInUse = m_options.protocolSha256;
    }

    /// A question has as many answers in a cell as the cell with the most; phases may differ in it.
    void countAnswersOfCells()
    {
        std::map<std::string, std::map<std::tuple<std::string, std::string, std::string>, std::size_t>> counts;
        for (const StudyResponse& response : m_data.responses)
            ++counts[response.question][{response.participant, response.fabric, response.condition}];
        const std::size_t cells = m_data.participants.size() * m_data.fabrics.size() * m_data.conditions.size();
        for (QuestionInfo& question : m_data.questions) {
            question.answersPerCell = 1;
            for (const auto& [cell, answers] : counts[question.id])
                question.answersPerCell = std::max(question.answersPerCell, answers);
            m_data.answersPerCell = std::max(m_data.answersPerCell, question.answersPerCell);
            m_data.expectedResponses += question.answersPerCell * cells;
        }
    }

    /// Adds a new name. A file may have one in each row, so no list is searched.
    static void remember(std::vector<std::string>& names, std::set<std::string>& known, const std::string& name)
    {
        if (known.insert(name).second) names.push_back(name);
    }

    /// An export names everything, and a participant or fabric of an earlier version may be called NA.
    bool isNameMissing(const std::string& name) const
    {
        return m_rows.isOwnExport ? nameWithoutBlanks(name).empty() : protocols::isMissing(name);
    }

    std::string named(std::size_t row, const char* column) const
    {
        const std::string& name = cell(row, *m_table.column(column));
        if (isNameMissing(name)) fail("the " + std::string(column) + " is empty", nameOf(row), "a name");
        if (name == reservedName)
            fail("a " + std::string(column) + " is called \"" + name + "\", which has a meaning of its own in result files",
                 nameOf(row), "another name");
        return name;
    }

    static std::string conditionOf(const std::string& name)
    {
        return protocols::faultOf(name) ? name : protocols::conditionIdFrom(name).value;
    }

    /// The text of an optional column; empty where it is missing.
    std::string optional(std::size_t row, const char* column) const
    {
        const auto index = m_table.column(column);
        return !index || protocols::isMissing(cell(row, *index)) ? std::string() : cell(row, *index);
    }

    /// "session 1, repetition 2"; empty without such columns.
    std::string repetitionOf(std::size_t row) const
    {
        std::string name;
        for (const char* column : {"session", "repetition"})
            if (const std::string value = optional(row, column); !value.empty())
                name += (name.empty() ? "" : ", ") + (column + (" " + value));
        if (const std::string given = instructionOf(row); !given.empty())
            name += (name.empty() ? "" : ", ") + ("instruction " + given);
        return name;
    }

    /// Empty where the row or the file names none.
    std::string instructionOf(std::size_t row) const
    {
        return !m_columns.instruction || protocols::isMissing(cell(row, *m_columns.instruction))
                   ? std::string()
                   : cell(row, *m_columns.instruction);
    }

    /// "mismatched 12", "repeated"; empty for a row of the list.
    std::string anchorOf(std::size_t row) const
    {
        return !m_columns.anchor || protocols::isMissing(cell(row, *m_columns.anchor)) ? std::string()
                                                                                       : cell(row, *m_columns.anchor);
    }

    /// None for a row of the list.
    static std::optional<AnchorKind> kindOf(const std::string& anchor)
    {
        return protocols::anchorKindNamed(anchor.substr(0, anchor.find(' ')));
    }

    /// Where the answers of such a row are kept.
    std::vector<StudyResponse>& responsesOf(const std::string& anchor, bool isCatch)
    {
        const auto kind = kindOf(anchor);
        if (kind == AnchorKind::Mismatched) return m_data.mismatchedResponses;
        if (kind == AnchorKind::Repeated) return m_data.repeatedResponses;
        return isCatch ? m_data.catchResponses : m_data.responses;
    }

    /// The question knows the instruction of its answer: the protocol's, or one that the file names first here.
    void learnInstruction(QuestionColumns& columns, const std::string& given)
    {
        if (given.empty() || !m_instructions[columns.info.id].insert(given).second) return;
        columns.info.instructions.push_back({given});
    }

    /// Whether the answer came after the deadline of its instruction, where both times are known.
    std::optional<bool> isLate(const QuestionInfo& question, const std::string& instruction, std::optional<double> taken) const
    {
        if (!m_options.protocol) return std::nullopt;  // no deadline is known, and instructions of a file may be many
        const auto given = std::ranges::find(question.instructions, instruction, &InstructionInfo::id);
        if (given == question.instructions.end() || !given->deadlineSeconds || !taken) return std::nullopt;
        return *taken > *given->deadlineSeconds;
    }

    void readGroup(std::size_t row, const std::string& participant)
    {
        if (!m_table.column("group")) return;
        const std::string group = optional(row, "group");
        if (group.empty()) fail("the group is empty", nameOf(row), "the name of the participant's group");
        const auto [known, isNew] = m_data.groupOf.emplace(participant, group);
        if (!isNew && known->second != group)
            fail("participant " + participant + " is in the groups " + known->second + " and " + group, nameOf(row),
                 "one group for each participant; a factor that changes within a participant is a condition");
    }

    void readRow(std::size_t row)
    {
        const std::string participant = named(row, "participant");
        const std::string fabric = named(row, "fabric");
        const std::string condition = conditionOf(named(row, "condition"));
        const std::string repetition = repetitionOf(row);
        const std::string anchor = anchorOf(row);
        if (!m_seen.insert({participant, fabric, condition, repetition, anchor}).second)
            fail("the answers of " + participant + " to " + fabric + " under " + condition +
                     (repetition.empty() ? "" : " in " + repetition) + (anchor.empty() ? "" : " (" + anchor + ")") +
                     " occur twice",
                 nameOf(row),
                 "one row a participant, fabric and condition, or a column `repetition`, `session` or `instruction`");
        readGroup(row, participant);
        remember(m_data.participants, m_participants, participant);
        const bool isCatch = m_rows.isOwnExport && condition == protocols::catchTrialId().value;
        if (!isCatch && anchor.empty()) {
            remember(m_data.fabrics, m_fabrics, fabric);
            remember(m_data.conditions, m_conditions, condition);
        }
        const std::optional<int> session = sessionIn(row, participant);
        const std::string instruction = instructionOf(row);
        const bool isOfShownFabric = condition != protocols::catchTrialId().value && kindOf(anchor) != AnchorKind::Mismatched;
        for (QuestionColumns& columns : m_columns.questions)
            if (const auto content = contentIn(row, columns)) {
                if (isOfShownFabric) compareScore(row, columns, *content, fabric);
                StudyResponse response{participant, fabric, condition, columns.info.id, *content};
                response.repetition = repetition;
                const std::optional<double> taken = secondsIn(m_table, row, columns.time);
                response.seconds = taken;
                response.trial = countIn(m_table, row, columns.trial ? columns.trial : m_columns.trial);
                const auto sitting = columns.sitting ? columns.sitting : m_columns.sitting;
                response.sitting = sitting ? countIn(m_table, row, sitting) : session;
                response.instruction = instruction;
                learnInstruction(columns, instruction);
                response.late = columns.late ? markAt(m_table, row, *columns.late, {"late", "in time"})
                                             : isLate(columns.info, instruction, taken);
                if (columns.touchedBy) response.touchedBy = cell(row, *columns.touchedBy);
                response.entries = countIn(m_table, row, columns.entries);
                responsesOf(anchor, isCatch).push_back(std::move(response));
            }
    }

    void rememberFabricsOfAnswers()
    {
        if (std::ranges::none_of(m_columns.questions, [](const QuestionColumns& columns) { return columns.answer.has_value(); }))
            return;
        const std::size_t column = *m_table.column("fabric");
        for (const auto& row : m_table.rows) m_answerable.insert(row[column]);
    }

    /// A score that the answer contradicts would count here, and the answer in the table of the fabrics chosen. An answer that is
    /// no fabric of the table says nothing.
    void compareScore(std::size_t row, const QuestionColumns& columns, const AnswerContent& content, const std::string& fabric)
    {
        const auto* choice = std::get_if<ChosenAnswer>(&content);
        if (choice == nullptr || !choice->answer || !m_answerable.contains(*choice->answer)) return;
        if (std::holds_alternative<protocols::SameDifferent>(columns.info.kind)) return;
        ScoresOfAnswers& scores = m_found.scores.try_emplace(columns.info.id, columns.info.id).first->second;
        scores.add(m_table, {row, *columns.value, choice->correct, *choice->answer, fabric, choice->slot.has_value()});
    }

    /// The number of the row's session in the order of the participant's rows, from 1.
    std::optional<int> sessionIn(std::size_t row, const std::string& participant)
    {
        const auto column = m_table.column("session");
        if (!column || protocols::isMissing(cell(row, *column))) return std::nullopt;
        std::map<std::string, int>& sessions = m_sessions[participant];
        return sessions.emplace(cell(row, *column), static_cast<int>(sessions.size()) + 1).first->second;
    }

    /// Whether an own export has an answer in words here, which may be empty, or NA.
    bool isGivenInWords(std::size_t row, const QuestionInfo& question) const
    {
        const auto given = m_rows.given.find(question.id);
        return given != m_rows.given.end() && row < given->second.size() && given->second[row] &&
               std::holds_alternative<OpenWords>(scoringOf(question.kind));
    }

    /// None where the cell is missing.
    std::optional<AnswerContent> contentIn(std::size_t row, const QuestionColumns& columns)
    {
        if (protocols::isMissing(cell(row, *columns.value)) && !isGivenInWords(row, columns.info)) return std::nullopt;
        const std::string place = nameOf(row) + ", column " + m_table.columns[*columns.value];
        return std::visit(
            protocols::Overloaded{
                [&](const RightOrWrong& scoring) -> AnswerContent { return choiceIn(row, columns, scoring, place); },
                [&](const NumberOnScale& scale) -> AnswerContent { return ratingIn(row, columns, scale, place); },
                [&](const OpenWords&) -> AnswerContent { return WordedAnswer{cell(row, *columns.value)}; },
            },
            scoringOf(columns.info.kind));
    }

    ChosenAnswer choiceIn(std::size_t row, const QuestionColumns& columns, const RightOrWrong& scoring,
                          const std::string& place) const
    {
        const std::string& score = cell(row, *columns.value);
        const auto number = protocols::numberIn(score);
        if (number != 0.0 && number != 1.0)
            fail("\"" + protocols::inShort(score, 60) + "\" is neither right nor wrong", place,
                 "0 or 1; or one of the words " + wordsForScores(),
                 "replace the words; where another column holds the right answers, name it by --map " +
                     (m_rows.made.contains(*columns.value) ? "correct" : m_table.columns[*columns.value]) + "=COLUMN");
        ChosenAnswer choice{number == 1.0, {}, {}};
        if (const auto slot = countIn(m_table, row, columns.slot)) choice.slot = *slot - 1;
        if (!columns.answer) return choice;
        const std::string& given = cell(row, *columns.answer);
        if (scoring.isSameDifferent ? protocols::isMissing(given) : isNameMissing(given)) return choice;
        choice.answer =
            scoring.isSameDifferent ? sameOrDifferentAt(m_table, row, *columns.answer) : std::string(nameWithoutBlanks(given));
        return choice;
    }

    /// Whether the table comes from an export of this program, which was checked against its protocol. Those of the first
    /// versions had fewer columns.
    bool isExport() const
    {
        const auto has = [this](const char* column) { return std::ranges::find(m_rows.unused, column) != m_rows.unused.end(); };
        return m_rows.isOwnExport || (has("stored_at") && has("touched_by") && has("corrections"));
    }

    RatedAnswer ratingIn(std::size_t row, const QuestionColumns& columns, const NumberOnScale& scale, const std::string& place)
    {
        const double number = answerNumberAt(m_table, row, *columns.value);
        if (number >= scale.min && number <= scale.max) return {number};
        const bool isScaleNamed = m_options.protocol || m_options.scale;
        if (isScaleNamed || !isExport())
            fail("the rating " + cell(row, *columns.value) + " is outside the scale", place,
                 protocols::shortest(scale.min) + " to " + protocols::shortest(scale.max) +
                     (isScaleNamed ? "" : ", because no scale is named"),
                 isScaleNamed ? ""
                              : "correct the cell, or name the scale: --scale LOW,HIGH is one for all questions, --protocol has "
                                "one for each");
        m_found.hasOtherScale = true;
        return {number};
    }

    std::string m_where;
    const AnswersCsvOptions& m_options;
    AnswerRows m_rows;
    const protocols::CsvTable& m_table = m_rows.table;
    StudyData m_data;
    std::vector<std::pair<std::string, std::string>> m_planned;  ///< contrasts of the caller, in the usual spelling
    FoundInCells m_found;
    AnswerColumns m_columns;
    std::set<std::string> m_participants, m_fabrics, m_conditions;  ///< names so far
    std::set<std::string> m_answerable;                             ///< fabrics of all rows, where answers may name them
    std::map<std::string, std::set<std::string>> m_instructions;    ///< of each question, so far
    std::map<std::string, std::map<std::string, int>> m_sessions;   ///< of each participant, with their numbers from 1
    /// Cells with their repetitions and anchors.
    std::set<std::tuple<std::string, std::string, std::string, std::string, std::string>> m_seen;
};

}  // namespace

StudyData readAnswersCsv(const std::filesystem::path& file, const AnswersCsvOptions& options)
{
    if (options.alternatives && *options.alternatives < 2)
        throw protocols::badInput({"a choice among " + std::to_string(*options.alternatives), "--alternatives", "2 or more", ""});
    return AnswersReader(file, options).read();
}

}  // namespace reports
