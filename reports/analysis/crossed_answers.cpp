#include "reports/analysis/crossed_answers.h"

namespace reports {

stats::CrossedStudy crossedAnswers(const StudyData& data, const AnswerCells& cells, const std::string& question)
{
    std::vector<std::string> participants, fabrics, conditions;
    stats::CrossedStudy study;
    for (const std::string& condition : data.conditions)
        for (const StudyResponse* response : cells.of(question, condition))
            for (const double value : valuesOf({response})) {
                participants.push_back(response->participant);
                fabrics.push_back(response->fabric);
                conditions.push_back(condition);
                study.values.push_back(value);
            }
    study.participant = stats::factorOf("participant", participants);
    study.fabric = stats::factorOf("fabric", fabrics);
    study.condition = stats::factorOf("condition", conditions);
    return study;
}

}  // namespace reports
