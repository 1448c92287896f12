#include "reports/analysis/instruction_analysis.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "reports/cells/response_time.h"
#include "stats/anova/within_anova.h"
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

using Cells = std::vector<stats::ConditionSpeedCells>;

stats::SpeedDifference shareDifference(const stats::ConditionSpeedCells& a, const stats::ConditionSpeedCells& b)
{
    std::vector<double> x, y;
    for (std::size_t k = 0; k < a.size(); ++k)
        if (a[k].share.exists() && b[k].share.exists()) {
            x.push_back(*a[k].share);
            y.push_back(*b[k].share);
        }
    return {stats::pairedTTest(x, y), {}};
}

std::vector<InstructionContrast> contrastsOf(const std::vector<InstructedSpeed>& instructions, const Cells& cells,
                                             const std::vector<std::vector<stats::Value>>& scores, int alternatives)
{
    std::vector<stats::ContrastPair> pairs;
    std::vector<InstructionContrast> contrasts;
    std::vector<stats::Value> p;
    for (std::size_t a = 0; a < instructions.size(); ++a)
        for (std::size_t b = a + 1; b < instructions.size(); ++b) {
            pairs.emplace_back(a, b);
            contrasts.push_back(
                {instructions[a].instruction.id, instructions[b].instruction.id, shareDifference(cells[a], cells[b]), {}});
            p.push_back(contrasts.back().share.test.p);
        }
    const auto tests = stats::speedContrasts(cells, scores, pairs, alternatives);
    const auto holm = stats::adjusted(p, stats::Adjustment::Holm);
    for (std::size_t i = 0; i < contrasts.size(); ++i) {
        contrasts[i].tests = tests[i];
        contrasts[i].share.pHolm = holm[i];
    }
    return contrasts;
}

/// Rows participant x condition x instruction; a cell without a number is NaN.
stats::TwoWayAnova anovaOf(const StudyData& data, const std::vector<std::string>& participants,
                           const std::vector<InstructedSpeed>& instructions, const std::vector<Cells>& cells,
                           const stats::Value stats::SpeedCell::*measure)
{
    std::vector<double> values;
    std::vector<std::string> who, condition, instruction;
    for (std::size_t k = 0; k < participants.size(); ++k)
        for (std::size_t c = 0; c < data.conditions.size(); ++c)
            for (std::size_t i = 0; i < instructions.size(); ++i) {
                values.push_back((cells[i][c][k].*measure).orElse(std::numeric_limits<double>::quiet_NaN()));
                who.push_back(participants[k]);
                condition.push_back(data.conditions[c]);
                instruction.push_back(instructions[i].instruction.id);
            }
    return stats::twoWayWithin(values, stats::factorOf("participant", who), stats::factorOf("condition", condition),
                               stats::factorOf("instruction", instruction));
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

InstructionAnalysis analyseInstructions(const StudyData& data, const std::string& question, int alternatives)
{
    InstructionAnalysis analysis;
    const std::vector<InstructedStudy> studies = splitByInstruction(data, question);
    if (studies.empty()) return analysis;
    std::vector<AnswerCells> answers;
    for (const InstructedStudy& study : studies) answers.emplace_back(study.data);
    std::vector<ParticipantsSpeed> overall;
    std::vector<std::vector<ParticipantsSpeed>> byCondition(studies.size());
    Cells overallCells, allCells;
    std::vector<Cells> conditionCells(studies.size());
    for (std::size_t i = 0; i < studies.size(); ++i) {
        analysis.instructions.push_back(countedUnder(studies[i], answers[i], question));
        overall.push_back(speedOverConditions(answers[i], question));
        overallCells.push_back(overall.back().cells);
        for (const std::string& condition : data.conditions) {
            byCondition[i].push_back(speedUnder(answers[i], question, condition));
            conditionCells[i].push_back(byCondition[i].back().cells);
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
                conditionSpeedOf(responses, byCondition[i][c], conditionScores[i * data.conditions.size() + c], alternatives));
        }
        analysis.instructions[i].speed = conditionSpeedOf(all, overall[i], scores[i], alternatives);
    }
    analysis.contrasts = contrastsOf(analysis.instructions, overallCells, scores, alternatives);
    const std::vector<std::string>& participants = answers.front().participants();
    analysis.shares = anovaOf(data, participants, analysis.instructions, conditionCells, &stats::SpeedCell::share);
    analysis.logSeconds = anovaOf(data, participants, analysis.instructions, conditionCells, &stats::SpeedCell::logSeconds);
    return analysis;
}

}  // namespace reports
