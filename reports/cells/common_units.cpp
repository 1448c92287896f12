#include "reports/cells/common_units.h"

#include <algorithm>
#include <cassert>
#include <map>
#include <string_view>
#include <utility>

#include "stats/kernels/decimal_grid.h"

namespace reports {
namespace {

/// What two answers about one fabric must share to belong to one unit.
using UnitLabel = std::pair<std::string_view, std::string_view>;  // repetition, instruction

UnitLabel unitLabelOf(const StudyResponse& response, UnitMark mark)
{
    switch (mark) {
        case UnitMark::Repetition:
            return {response.repetition, response.instruction};
        case UnitMark::Instruction:
            return {{}, response.instruction};
        case UnitMark::None:
            break;
    }
    return {};
}

/// The answers of one participant about one fabric, by condition.
using AnswersOfFabrics = std::map<std::string_view, AnswersByCondition>;

AnswersOfFabrics byFabricName(const AnswersByCondition& answers)
{
    AnswersOfFabrics fabrics;
    for (std::size_t c = 0; c < answers.size(); ++c)
        for (const StudyResponse* response : answers[c]) {
            AnswersByCondition& ofFabric = fabrics[response->fabric];
            ofFabric.resize(answers.size());
            ofFabric[c].push_back(response);
        }
    return fabrics;
}

/// In their order, so that equal lists are the same units.
std::vector<UnitLabel> sortedLabels(const std::vector<const StudyResponse*>& answers, UnitMark mark)
{
    std::vector<UnitLabel> labels;
    for (const StudyResponse* response : answers) labels.push_back(unitLabelOf(*response, mark));
    std::ranges::sort(labels);
    return labels;
}

/// Answers with a label under each condition; 0: the unit is not common.
using LeastAnswers = std::map<UnitLabel, std::size_t>;

LeastAnswers leastAnswers(const AnswersByCondition& ofFabric, UnitMark mark, UnitNeeds needs)
{
    LeastAnswers least;
    bool isFirst = true;
    for (const auto& answers : ofFabric) {
        if (answers.empty() && needs == UnitNeeds::AnsweredCondition) continue;
        LeastAnswers own;
        for (const StudyResponse* response : answers) ++own[unitLabelOf(*response, mark)];
        if (isFirst) least = own;
        for (auto& [label, count] : least) {
            const auto found = own.find(label);
            count = found == own.end() ? 0 : std::min(count, found->second);
        }
        isFirst = false;
    }
    return least;
}

/// Whether every unit has equally many answers under all conditions that have some.
bool areEven(const AnswersByCondition& ofFabric, UnitMark mark)
{
    std::vector<UnitLabel> first;
    bool isEven = true;
    for (const auto& answers : ofFabric) {
        if (answers.empty()) continue;
        std::vector<UnitLabel> labels = sortedLabels(answers, mark);
        isEven = isEven && (first.empty() || labels == first);
        first = std::move(labels);
    }
    return isEven;
}

/// The units of the answers; all are one where they are even.
std::vector<std::vector<const StudyResponse*>> countedUnits(const std::vector<const StudyResponse*>& answers, UnitMark mark,
                                                            bool isEven)
{
    if (answers.empty()) return {};
    if (isEven) return {answers};
    std::map<UnitLabel, std::vector<const StudyResponse*>> byLabel;
    for (const StudyResponse* response : answers) byLabel[unitLabelOf(*response, mark)].push_back(response);
    std::vector<std::vector<const StudyResponse*>> units;
    for (auto& [label, ofUnit] : byLabel) units.push_back(std::move(ofUnit));
    return units;
}

/// Mean over the answers. Where a unit has more of them under some condition, units count equally.
stats::Value meanOfUnits(const std::vector<const StudyResponse*>& answers, UnitMark mark, bool isEven)
{
    if (isEven) return stats::meanOf(valuesOf(answers));
    std::vector<double> means;
    for (const auto& ofUnit : countedUnits(answers, mark, isEven))
        if (const stats::Value mean = stats::meanOf(valuesOf(ofUnit)); mean.exists()) means.push_back(*mean);
    return means.size() == 1 ? stats::Value(means.front()) : stats::meanOf(means);
}

}  // namespace

CommonUnits::CommonUnits(const AnswerCells& cells, std::string question, std::vector<std::string> conditions, UnitNeeds needs)
    : m_cells(cells), m_question(std::move(question)), m_conditions(std::move(conditions)), m_needs(needs)
{
    if (cells.mostAnswers(m_question) < 2 || m_conditions.size() < 2) return;
    m_mark = isShared(UnitMark::Repetition)    ? UnitMark::Repetition
             : isShared(UnitMark::Instruction) ? UnitMark::Instruction
                                               : UnitMark::None;
}

bool CommonUnits::isShared(UnitMark mark) const
{
    bool haveMet = mark == UnitMark::Instruction;
    const std::size_t most = m_cells.mostAnswers(m_question);
    for (const std::string& participant : m_cells.participants())
        for (const auto& [fabric, ofFabric] : byFabricName(allAnswers(participant))) {
            std::vector<UnitLabel> full;
            std::size_t answered = 0;
            for (const auto& answers : ofFabric) {
                answered += answers.empty() ? 0 : 1;
                if (answers.size() < most) continue;
                std::vector<UnitLabel> labels = sortedLabels(answers, mark);
                if (!full.empty() && labels != full) return false;
                full = std::move(labels);
            }
            if (haveMet || answered < 2) continue;
            haveMet = std::ranges::any_of(leastAnswers(ofFabric, mark, m_needs), [](const auto& one) { return one.second > 0; });
        }
    return haveMet;
}

AnswersByCondition CommonUnits::allAnswers(const std::string& participant) const
{
    AnswersByCondition all;
    for (const std::string& condition : m_conditions) all.push_back(m_cells.of(m_question, condition, participant));
    return all;
}

AnswersByCondition CommonUnits::commonAnswers(const std::string& participant, const CountsAnswer& counts, bool isPaired) const
{
    AnswersByCondition all = allAnswers(participant);
    if (counts)
        for (auto& answers : all) std::erase_if(answers, [&](const StudyResponse* response) { return !counts(*response); });
    if (m_mark == UnitMark::None && m_needs == UnitNeeds::AnsweredCondition && !isPaired)
        return all;  // no answer lacks a partner
    AnswersByCondition common(all.size());
    for (const auto& [fabric, ofFabric] : byFabricName(all)) {
        const LeastAnswers least = leastAnswers(ofFabric, m_mark, m_needs);
        for (std::size_t c = 0; c < ofFabric.size(); ++c) {
            LeastAnswers taken;
            for (const StudyResponse* response : ofFabric[c]) {
                const UnitLabel label = unitLabelOf(*response, m_mark);
                const auto found = least.find(label);
                if (found == least.end() || found->second == 0) continue;
                if (isPaired && taken[label]++ >= found->second) continue;
                common[c].push_back(response);
            }
        }
    }
    return common;
}

AnswersByCondition CommonUnits::answers(const std::string& participant, const CountsAnswer& counts) const
{
    return commonAnswers(participant, counts, false);
}

AnswersByCondition CommonUnits::pairedAnswers(const std::string& participant, const CountsAnswer& counts) const
{
    return commonAnswers(participant, counts, true);
}

std::vector<CommonUnits::FabricMeans> CommonUnits::fabrics(const std::string& participant) const
{
    std::vector<FabricMeans> fabrics;
    for (const auto& [fabric, ofFabric] : byFabricName(answers(participant))) {
        const bool isEven = areEven(ofFabric, m_mark);
        FabricMeans one{std::string(fabric), {}};
        for (const auto& answers : ofFabric) one.means.push_back(meanOfUnits(answers, m_mark, isEven));
        fabrics.push_back(std::move(one));
    }
    return fabrics;
}

std::vector<CommonUnits::FabricUnits> CommonUnits::units(const std::string& participant) const
{
    std::vector<FabricUnits> fabrics;
    for (const auto& [fabric, ofFabric] : byFabricName(answers(participant))) {
        const bool isEven = areEven(ofFabric, m_mark);
        FabricUnits one{std::string(fabric), {}};
        for (const auto& answers : ofFabric) one.units.push_back(countedUnits(answers, m_mark, isEven));
        fabrics.push_back(std::move(one));
    }
    return fabrics;
}

std::vector<double> CommonUnits::means(const std::string& participant) const
{
    assert(m_needs == UnitNeeds::EveryCondition && "otherwise a condition may have no mean");
    return meansOverFabrics(fabrics(participant));
}

bool CommonUnits::leavesOutAnswers(const std::string& participant) const
{
    const auto countOf = [](const AnswersByCondition& answers) {
        std::size_t count = 0;
        for (const auto& ofCondition : answers) count += ofCondition.size();
        return count;
    };
    return countOf(answers(participant)) < countOf(allAnswers(participant));
}

std::vector<double> meansOverFabrics(const std::vector<CommonUnits::FabricMeans>& fabrics)
{
    std::vector<double> means;
    for (std::size_t c = 0; !fabrics.empty() && c < fabrics.front().means.size(); ++c) {
        std::vector<double> own;
        for (const CommonUnits::FabricMeans& one : fabrics)
            if (one.means[c].exists()) own.push_back(*one.means[c]);
        if (own.empty()) return {};
        means.push_back(*stats::meanOf(own));
    }
    return means;
}

}  // namespace reports
