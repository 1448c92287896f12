#include "reports/cells/crossed_answers.h"

namespace reports {

namespace {

/// Collects rows and makes factors of their names.
struct CrossedRows {
    std::vector<std::string> participants, fabrics, conditions;
    std::vector<double> values;

    void add(const StudyResponse& of, double value)
    {
        participants.push_back(of.participant);
        fabrics.push_back(of.fabric);
        conditions.push_back(of.condition);
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
    CrossedRows rows;
    for (const std::string& condition : data.conditions)
        for (const StudyResponse* response : cells.of(question, condition))
            for (const double value : valuesOf({response})) rows.add(*response, value);
    return rows.study();
}

stats::CrossedStudy crossedCells(const StudyData& data, const AnswerCells& cells, const std::string& question)
{
    CrossedRows rows;
    for (const std::string& condition : data.conditions)
        for (const AnswerCells::CellMean& cell : cells.cellMeans(question, condition)) rows.add(*cell.first, cell.mean);
    return rows.study();
}

}  // namespace reports
