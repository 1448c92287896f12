#include "reports/analysis/worded_analysis.h"

#include <set>

namespace reports {

WordedAnalysis collectWords(const StudyData& data, const AnswerCells& cells, const std::string& question)
{
    WordedAnalysis analysis;
    for (const std::string& condition : data.conditions) {
        std::set<std::string> participants;
        const auto responses = cells.of(question, condition);
        for (const StudyResponse* response : responses) participants.insert(response->participant);
        analysis.conditions.push_back({responses.size(), participants.size()});
    }
    for (const std::string& participant : cells.participants())
        for (const StudyResponse* response : cells.ofParticipant(question, participant))
            if (const auto* worded = std::get_if<WordedAnswer>(&response->content))
                analysis.answers.push_back({participant, response->fabric, response->condition, worded->words});
    return analysis;
}

}  // namespace reports
