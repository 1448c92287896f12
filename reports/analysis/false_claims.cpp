#include "reports/analysis/false_claims.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "reports/cells/common_units.h"
#include "reports/cells/crossed_answers.h"
#include "stats/kernels/decimal_grid.h"
#include "stats/power/measured_claims.h"

namespace reports {
namespace {

/// SD of a random effect, 0 where the effect was left out.
double sdOfEffect(const stats::RatingModel& fitted, const std::string& effect)
{
    for (const stats::RandomEffect& one : fitted.model.random)
        if (one.name == effect && one.sd.exists()) return *one.sd;
    return 0;
}

double sdOfEffect(const stats::ChoiceModel& fitted, const std::string& effect)
{
    for (const stats::RandomIntercept& one : fitted.model.random)
        if (one.name == effect && one.sd.exists()) return *one.sd;
    return 0;
}

using NumbersOfAnswers = std::map<const StudyResponse*, std::size_t>;

std::map<std::string, std::size_t> placesByName(const std::vector<std::string>& names)
{
    std::map<std::string, std::size_t> places;
    for (const std::string& name : names) places.emplace(name, places.size());
    return places;
}

/// Nothing is added where no unit has an answer.
void addComparedCell(std::vector<stats::ComparedCell>& cells, std::size_t participant, std::size_t fabric,
                     const std::vector<std::vector<const StudyResponse*>>& units, const NumbersOfAnswers& numbers)
{
    stats::ComparedCell cell{participant, fabric, {}};
    for (const auto& answers : units) {
        std::vector<std::size_t> ofUnit;
        for (const StudyResponse* answer : answers)
            if (const auto found = numbers.find(answer); found != numbers.end()) ofUnit.push_back(found->second);
        if (!ofUnit.empty()) cell.units.push_back(std::move(ofUnit));
    }
    if (!cell.units.empty()) cells.push_back(std::move(cell));
}

/// Every answer of cells that were asked more than once, and those on which each contrast compares its conditions.
void addRepetitions(stats::StudyNull& null, const StudyData& data, const AnswerCells& cells, const std::string& question)
{
    if (cells.mostAnswers(question) < 2) return;
    const auto people = placesByName(cells.participants()), fabrics = placesByName(data.fabrics);
    NumbersOfAnswers numbers;
    for (std::size_t c = 0; c < data.conditions.size(); ++c)
        for (const StudyResponse* answer : cells.of(question, data.conditions[c])) {
            if (valuesOf({answer}).empty()) continue;
            numbers.emplace(answer, null.answers.size());
            null.answers.push_back({c, people.at(answer->participant), fabrics.at(answer->fabric)});
        }
    for (const auto& [a, b] : null.contrasts) {
        const CommonUnits units(cells, question, {data.conditions[a], data.conditions[b]});
        stats::ComparedConditions compared{{a, b}, {}, {}};
        for (std::size_t p = 0; p < cells.participants().size(); ++p)
            for (const CommonUnits::FabricUnits& one : units.units(cells.participants()[p])) {
                addComparedCell(compared.ofA, p, fabrics.at(one.fabric), one.units[0], numbers);
                addComparedCell(compared.ofB, p, fabrics.at(one.fabric), one.units[1], numbers);
            }
        null.compared.push_back(std::move(compared));
    }
}

template <class Model>
stats::StudyNull nullOf(const StudyData& data, const AnswerCells& cells, const std::string& question, stats::AnswerValues kind,
                        const Model& model, const QuestionClaims& claims)
{
    stats::StudyNull null;
    null.participantSd = sdOfEffect(model, "participant");
    null.fabricSd = sdOfEffect(model, "fabric");
    null.participantConditionSd = sdOfEffect(model, "participant:condition");
    null.fabricConditionSd = sdOfEffect(model, "fabric:condition");
    null.asked = answerCube(data, cells, question, kind);
    std::vector<double> means;
    for (const std::string& condition : data.conditions)
        for (const AnswerCells::CellMean& cell : cells.cellMeans(question, condition)) means.push_back(cell.mean);
    null.centre = stats::meanOf(means).orElse(0);
    for (const ContrastFinding& finding : claims.contrasts)
        if (finding.generalisation == stats::Generalisation::FabricsLikeThese)
            null.contrasts.emplace_back(finding.claim.a, finding.claim.b);
    addRepetitions(null, data, cells, question);
    return null;
}

/// `residual`: the fitted SD of a cell's mean. What its answers differ by explains a part of it; they share the rest, so that
/// simulated cells vary as the fitted ones do.
void setResiduals(stats::StudyNull& null, double residual, const AnswersOfCells& answers)
{
    const double ratio = answers.sd / residual, ofAnswer = std::min(ratio * ratio, answers.perCell);
    null.residualSd = residual * std::sqrt(1 - ofAnswer / answers.perCell);
    null.answerSd = residual * std::sqrt(ofAnswer);
}

FalseClaimFinding findingFor(const std::string& question, const stats::StudyNull& null, double unit, std::size_t studies)
{
    const bool isChoice = null.asked.kind() == stats::AnswerValues::Choices;
    const stats::ClaimNull kept{isChoice, null.participantConditionSd / unit, null.fabricConditionSd / unit, false};
    FalseClaimFinding finding{question,
                              kept.participantSd,
                              kept.fabricSd,
                              stats::falseClaimRate(stats::contrastOfFabricsLikeThese, kept),
                              stats::falseClaimRate(stats::anyContrastOfFabricsLikeThese, kept),
                              {}};
    const bool hasTest = !null.contrasts.empty() && null.asked.participants() > 1 && null.asked.fabrics() > 1;
    if (studies > 0 && hasTest) {
        stats::SimulationOptions options;
        options.studies = studies;
        finding.simulated = stats::simulateStudyNull(null, options);
    }
    return finding;
}

}  // namespace

std::optional<FalseClaimFinding> falseClaimsOf(const StudyData& data, const AnswerCells& cells, const std::string& question,
                                               const RatingAnalysis& ratings, std::size_t studies)
{
    if (!ratings.model.model.why.empty() || !(ratings.model.model.residualSd.orElse(0) > 0)) return std::nullopt;
    stats::StudyNull null = nullOf(data, cells, question, stats::AnswerValues::Ratings, ratings.model, ratings.claims);
    null.lowest = ratings.scale.min;
    null.highest = ratings.scale.max;
    const double residual = *ratings.model.model.residualSd;
    setResiduals(null, residual, answersOfCells(data, cells, question));
    return findingFor(question, null, residual / stats::claimResidualSd, studies);
}

std::optional<FalseClaimFinding> falseClaimsOf(const StudyData& data, const AnswerCells& cells, const std::string& question,
                                               const ChoiceAnalysis& choices, std::size_t studies)
{
    if (!choices.crossedModel.model.why.empty()) return std::nullopt;
    stats::StudyNull null = nullOf(data, cells, question, stats::AnswerValues::Choices, choices.crossedModel, choices.claims);
    return findingFor(question, null, 1, studies);
}

}  // namespace reports
