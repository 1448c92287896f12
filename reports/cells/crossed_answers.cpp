#include "reports/cells/crossed_answers.h"

#include "reports/cells/common_units.h"

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

}  // namespace reports
