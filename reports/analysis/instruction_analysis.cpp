#include "reports/analysis/instruction_analysis.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "reports/cells/chance_level.h"
#include "reports/cells/common_units.h"
#include "reports/cells/response_time.h"
#include "stats/anova/within_anova.h"
#include "stats/kernels/decimal_grid.h"
#include "stats/models/factor.h"
#include "stats/tests/multiplicity.h"
#include "stats/tests/t_tests.h"

namespace reports {
namespace {

/// The answers to one question under one instruction, as a study of its own.
struct InstructedStudy {
    StudyData data;
    InstructionInfo instruction;
};

std::vector<InstructionInfo> instructionsOf(const StudyData& data, const std::string& question)
{
    for (const QuestionInfo& known : data.questions)
        if (known.id == question) return known.instructions;
    return {};
}

/// Without the answers: a study may hold millions of them.
StudyData frameOf(const StudyData& data)
{
    StudyData frame;
    frame.participants = data.participants;
    frame.fabrics = data.fabrics;
    frame.conditions = data.conditions;
    frame.questions = data.questions;
    frame.times = data.times;
    return frame;
}

std::vector<InstructedStudy> splitByInstruction(const StudyData& data, const std::string& question)
{
    std::vector<InstructedStudy> parts;
    for (const InstructionInfo& instruction : instructionsOf(data, question)) parts.push_back({frameOf(data), instruction});
    for (const StudyResponse& response : data.responses) {
        if (response.question != question) continue;
        const auto part = std::ranges::find(parts, response.instruction, [](const auto& one) { return one.instruction.id; });
        if (part != parts.end()) part->data.responses.push_back(response);
    }
    return parts;
}

std::vector<const StudyResponse*> responsesIn(const InstructedStudy& study)
{
    std::vector<const StudyResponse*> responses;
    for (const StudyResponse& response : study.data.responses) responses.push_back(&response);
    return responses;
}

using Cells = std::vector<stats::ConditionSpeedCells>;

/// The place of a name, with leading zeros, so that the names of these texts stand in the order of the list.
std::string sortedPlace(const std::vector<std::string>& names, const std::string& name)
{
    const std::string place = std::to_string(std::ranges::find(names, name) - names.begin());
    return std::string(10 - std::min<std::size_t>(place.size(), 10), '0') + place;
}

/// The name of a repetition without that of its instruction, with which it ends.
std::string withoutInstruction(const StudyResponse& response)
{
    const std::string& name = response.repetition;
    return name.ends_with(response.instruction) ? name.substr(0, name.size() - response.instruction.size()) : name;
}

/// The choices as a study that compares other things than conditions. Its cells are found by the units of every comparison.
class RecastStudy {
public:
    using NameOf = std::function<std::string(const StudyResponse&)>;

    RecastStudy(const StudyData& data, const std::string& question, const std::vector<InstructedStudy>& parts,
                std::vector<std::string> conditions, const NameOf& conditionOf, const NameOf& fabricOf)
        : m_data(frameOf(data)), m_question(question)
    {
        m_data.conditions = std::move(conditions);
        std::set<std::string> fabrics;
        for (const InstructedStudy& part : parts)
            for (StudyResponse response : part.data.responses) {
                const std::string condition = conditionOf(response);
                response.fabric = fabricOf(response);
                response.condition = condition;
                response.repetition = withoutInstruction(response);
                response.instruction.clear();
                fabrics.insert(response.fabric);
                m_data.responses.push_back(std::move(response));
            }
        m_data.fabrics.assign(fabrics.begin(), fabrics.end());
        m_cells.emplace(m_data);
    }
    RecastStudy(const RecastStudy&) = delete;
    RecastStudy& operator=(const RecastStudy&) = delete;

    const AnswerCells& cells() const { return *m_cells; }
    CommonUnits units(std::vector<std::string> conditions) const { return {*m_cells, m_question, std::move(conditions)}; }
    const std::vector<std::string>& conditions() const { return m_data.conditions; }

private:
    StudyData m_data;
    std::string m_question;
    std::optional<AnswerCells> m_cells;
};

/// Whether anybody answered about the same under both. Where a list was split between instructions, nobody did.
bool haveCommonUnits(const AnswerCells& cells, const CommonUnits& units)
{
    return std::ranges::any_of(cells.participants(), [&](const std::string& one) { return !units.answers(one).front().empty(); });
}

stats::SpeedDifference differenceOfShares(const stats::ConditionSpeedCells& a, const stats::ConditionSpeedCells& b)
{
    std::vector<double> x, y;
    for (std::size_t k = 0; k < a.size(); ++k)
        if (a[k].share.exists() && b[k].share.exists()) {
            x.push_back(*a[k].share);
            y.push_back(*b[k].share);
        }
    return {stats::pairedTTest(x, y), {}};
}

stats::SpeedDifference differenceOfShares(const AnswerCells& cells, const CommonUnits& units)
{
    stats::ConditionSpeedCells a, b;
    for (const std::string& participant : cells.participants()) {
        const AnswersByCondition answers = units.pairedAnswers(participant);
        a.push_back(stats::speedCell(valuesOf(answers[0]), {}));
        b.push_back(stats::speedCell(valuesOf(answers[1]), {}));
    }
    return differenceOfShares(a, b);
}

/// Instructions take the place of conditions, and condition x fabric that of fabrics. A list that was split between instructions
/// has nothing in common: there all choices are compared.
std::vector<InstructionContrast> contrastsOf(const StudyData& data, const std::string& question,
                                             const std::vector<InstructedStudy>& parts, const Cells& cells,
                                             const std::vector<std::vector<stats::Value>>& scores, const RightOrWrong& scoring)
{
    std::vector<std::string> ids;
    for (const InstructedStudy& part : parts) ids.push_back(part.instruction.id);
    const RecastStudy recast(
        data, question, parts, ids, [](const StudyResponse& one) { return one.instruction; },
        [&](const StudyResponse& one) { return sortedPlace(data.conditions, one.condition) + one.fabric; });
    std::vector<stats::SpeedPair> pairs;
    std::vector<InstructionContrast> contrasts;
    std::vector<stats::Value> p;
    for (std::size_t a = 0; a < ids.size(); ++a)
        for (std::size_t b = a + 1; b < ids.size(); ++b) {
            const CommonUnits units = recast.units({ids[a], ids[b]});
            const bool areCrossed = haveCommonUnits(recast.cells(), units);
            pairs.push_back(areCrossed ? comparedSpeed(recast.cells(), units, cells, scores, {a, b})
                                       : stats::SpeedPair{cells[a], cells[b], scores[a], scores[b]});
            for (const std::size_t side : {b, a})
                if (std::string why = whyNoChance(scoring, responsesIn(parts[side])); !why.empty())
                    pairs.back().noBits = std::move(why);
            contrasts.push_back({ids[a],
                                 ids[b],
                                 areCrossed ? differenceOfShares(recast.cells(), units) : differenceOfShares(cells[a], cells[b]),
                                 {}});
            p.push_back(contrasts.back().share.test.p);
        }
    const auto tests = stats::speedContrasts(pairs, scoring.alternatives);
    const auto holm = stats::adjusted(p, stats::Adjustment::Holm);
    for (std::size_t i = 0; i < contrasts.size(); ++i) {
        contrasts[i].tests = tests[i];
        contrasts[i].share.pHolm = holm[i];
    }
    return contrasts;
}

/// Cells of participant x condition x instruction on the fabrics that the participant answered in all of them. Where a cell has
/// no answer at all, the others stay as they are: the participant is left out, and the rest shows the levels.
class FactorCells {
public:
    FactorCells(const StudyData& data, const std::string& question, const std::vector<InstructedStudy>& parts)
        : m_instructions(parts.size()),
          m_recast(
              data, question, parts, cellNames(data, parts),
              [&](const StudyResponse& one) { return cellName(data, one.condition, one.instruction); },
              [](const StudyResponse& one) { return one.fabric; }),
          m_units(m_recast.units(m_recast.conditions())),
          m_question(question)
    {
    }

    /// The answers that count, by condition and instruction.
    AnswersByCondition answers(const std::string& participant, const CountsAnswer& counts) const
    {
        AnswersByCondition all;
        for (const std::string& cell : m_recast.conditions()) {
            all.push_back(m_recast.cells().of(m_question, cell, participant));
            std::erase_if(all.back(), [&](const StudyResponse* one) { return !counts(*one); });
        }
        const bool isWhole = std::ranges::none_of(all, [](const auto& one) { return one.empty(); });
        return isWhole ? m_units.answers(participant, counts) : all;
    }

    const std::vector<std::string>& participants() const { return m_recast.cells().participants(); }
    std::size_t instructions() const { return m_instructions; }

private:
    static std::string cellName(const StudyData& data, const std::string& condition, const std::string& instruction)
    {
        return sortedPlace(data.conditions, condition) + instruction;
    }
    static std::vector<std::string> cellNames(const StudyData& data, const std::vector<InstructedStudy>& parts)
    {
        std::vector<std::string> names;
        for (const std::string& condition : data.conditions)
            for (const InstructedStudy& part : parts) names.push_back(cellName(data, condition, part.instruction.id));
        return names;
    }

    std::size_t m_instructions;
    RecastStudy m_recast;
    CommonUnits m_units;
    std::string m_question;
};

/// Rows participant x condition x instruction; a cell without a number is NaN.
stats::TwoWayAnova anovaOf(const StudyData& data, const std::vector<InstructedStudy>& parts, const FactorCells& cells,
                           const std::function<std::optional<double>(const StudyResponse&)>& numberIn)
{
    std::vector<double> values;
    std::vector<std::string> who, condition, instruction;
    for (const std::string& participant : cells.participants()) {
        const auto answers =
            cells.answers(participant, [&](const StudyResponse& response) { return numberIn(response).has_value(); });
        for (std::size_t cell = 0; cell < answers.size(); ++cell) {
            std::vector<double> numbers;
            for (const StudyResponse* response : answers[cell]) numbers.push_back(*numberIn(*response));
            values.push_back(stats::meanOf(numbers).orElse(std::numeric_limits<double>::quiet_NaN()));
            who.push_back(participant);
            condition.push_back(data.conditions[cell / cells.instructions()]);
            instruction.push_back(parts[cell % cells.instructions()].instruction.id);
        }
    }
    return stats::twoWayWithin(values, stats::factorOf("participant", who), stats::factorOf("condition", condition),
                               stats::factorOf("instruction", instruction));
}

std::optional<double> correctnessOf(const StudyResponse& response)
{
    const std::vector<double> numbers = valuesOf({&response});
    return numbers.empty() ? std::nullopt : std::optional(numbers.front());
}

/// Whether everybody with an answer has one about every condition x fabric under each instruction.
bool isEverythingAnswered(const StudyData& data, const std::vector<InstructedStudy>& parts)
{
    std::map<std::string, std::set<std::tuple<std::string, std::string, std::string>>> answered;
    for (const InstructedStudy& part : parts)
        for (const StudyResponse& one : part.data.responses)
            answered[one.participant].emplace(one.condition, one.fabric, one.instruction);
    const std::size_t all = data.conditions.size() * data.fabrics.size() * parts.size();
    return std::ranges::all_of(answered, [&](const auto& one) { return one.second.size() == all; });
}

InstructedSpeed countedUnder(const InstructedStudy& study, const AnswerCells& cells, const std::string& question)
{
    InstructedSpeed under;
    under.instruction = study.instruction;
    for (const StudyResponse& response : study.data.responses) {
        ++under.answers;
        under.timed += response.late.has_value();
        under.late += response.late.value_or(false);
    }
    under.accuracy = accuracyBySpeed(study.data, cells, question);
    return under;
}

}  // namespace

InstructionAnalysis analyseInstructions(const StudyData& data, const std::string& question, const RightOrWrong& scoring)
{
    InstructionAnalysis analysis;
    const std::vector<InstructedStudy> studies = splitByInstruction(data, question);
    if (studies.empty()) return analysis;
    std::vector<AnswerCells> answers;
    for (const InstructedStudy& study : studies) answers.emplace_back(study.data);
    std::vector<ParticipantsSpeed> overall;
    std::vector<std::vector<ParticipantsSpeed>> byCondition(studies.size());
    Cells overallCells, allCells;
    for (std::size_t i = 0; i < studies.size(); ++i) {
        analysis.instructions.push_back(countedUnder(studies[i], answers[i], question));
        overall.push_back(speedOverConditions(answers[i], question));
        overallCells.push_back(overall.back().cells);
        for (const std::string& condition : data.conditions) {
            byCondition[i].push_back(speedUnder(answers[i], question, condition));
            allCells.push_back(byCondition[i].back().cells);
        }
    }
    const auto scores = stats::scoresOf(overallCells), conditionScores = stats::scoresOf(allCells);
    for (std::size_t i = 0; i < studies.size(); ++i) {
        std::vector<const StudyResponse*> all;
        for (std::size_t c = 0; c < data.conditions.size(); ++c) {
            const auto responses = answers[i].of(question, data.conditions[c]);
            all.insert(all.end(), responses.begin(), responses.end());
            analysis.instructions[i].conditions.push_back(
                conditionSpeedOf(responses, byCondition[i][c], conditionScores[i * data.conditions.size() + c], scoring));
        }
        analysis.instructions[i].speed = conditionSpeedOf(all, overall[i], scores[i], scoring);
    }
    analysis.contrasts = contrastsOf(data, question, studies, overallCells, scores, scoring);
    const FactorCells factors(data, question, studies);
    analysis.shares = anovaOf(data, studies, factors, correctnessOf);
    analysis.logSeconds = anovaOf(data, studies, factors, logTimeOf);
    analysis.isComplete = isEverythingAnswered(data, studies);
    return analysis;
}

}  // namespace reports
