#include "reports/cells/crossed_answers.h"

#include <cmath>

#include "reports/cells/common_units.h"
#include "stats/kernels/decimal_grid.h"

namespace reports {

namespace {

/// Collects rows and makes factors of their names.
struct CrossedRows {
    std::vector<std::string> participants, fabrics, conditions;
    std::vector<double> values;

    void add(const std::string& participant, const std::string& fabric, const std::string& condition, double value)
    {
        participants.push_back(participant);
        fabrics.push_back(fabric);
        conditions.push_back(condition);
        values.push_back(value);
    }
    stats::CrossedStudy study() const
    {
        return {stats::factorOf("participant", participants), stats::factorOf("fabric", fabrics),
                stats::factorOf("condition", conditions), values};
    }
};

/// Adds up the variation of answers within their cells.
struct VariationInCells {
    double squares = 0;           ///< deviations from the means of the cells
    std::size_t degrees = 0;      ///< of freedom
    double variancesOfMeans = 0;  ///< of cells, where an answer has the variance 1
    std::size_t cells = 0;

    /// `units` of one cell count equally.
    void add(const std::vector<std::vector<const StudyResponse*>>& units)
    {
        std::vector<double> all;
        double variance = 0, count = 0;
        for (const auto& answers : units) {
            const std::vector<double> values = valuesOf(answers);
            if (values.empty()) continue;
            all.insert(all.end(), values.begin(), values.end());
            variance += 1 / static_cast<double>(values.size());
            ++count;
        }
        if (all.empty()) return;
        ++cells;
        variancesOfMeans += variance / (count * count);
        degrees += all.size() - 1;
        const double mean = stats::meanOf(all).orElse(0);
        for (const double value : all) squares += (value - mean) * (value - mean);
    }
};

}  // namespace

stats::CrossedStudy crossedAnswers(const StudyData& data, const AnswerCells& cells, const std::string& question)
{
    const CommonUnits units(cells, question, data.conditions, UnitNeeds::AnsweredCondition);
    std::vector<AnswersByCondition> answers;
    for (const std::string& participant : cells.participants()) answers.push_back(units.answers(participant));
    CrossedRows rows;
    for (std::size_t c = 0; c < data.conditions.size(); ++c)
        for (const AnswersByCondition& ofParticipant : answers)
            for (const StudyResponse* response : ofParticipant[c])
                for (const double value : valuesOf({response}))
                    rows.add(response->participant, response->fabric, response->condition, value);
    return rows.study();
}

stats::CrossedStudy crossedCells(const StudyData& data, const AnswerCells& cells, const std::string& question)
{
    const CommonUnits units(cells, question, data.conditions, UnitNeeds::AnsweredCondition);
    std::vector<std::vector<CommonUnits::FabricMeans>> fabrics;
    for (const std::string& participant : cells.participants()) fabrics.push_back(units.fabrics(participant));
    CrossedRows rows;
    for (std::size_t c = 0; c < data.conditions.size(); ++c)
        for (std::size_t p = 0; p < fabrics.size(); ++p)
            for (const CommonUnits::FabricMeans& one : fabrics[p])
                if (one.means[c].exists()) rows.add(cells.participants()[p], one.fabric, data.conditions[c], *one.means[c]);
    return rows.study();
}

AnswersOfCells answersOfCells(const StudyData& data, const AnswerCells& cells, const std::string& question)
{
    if (cells.mostAnswers(question) < 2) return {};
    const CommonUnits units(cells, question, data.conditions, UnitNeeds::AnsweredCondition);
    VariationInCells variation;
    for (const std::string& participant : cells.participants())
        for (const CommonUnits::FabricUnits& fabric : units.units(participant))
            for (const auto& ofCondition : fabric.units) variation.add(ofCondition);
    AnswersOfCells answers;
    if (variation.cells > 0) answers.perCell = static_cast<double>(variation.cells) / variation.variancesOfMeans;
    if (variation.degrees > 0) answers.sd = std::sqrt(variation.squares / static_cast<double>(variation.degrees));
    return answers;
}

}  // namespace reports
