// The answers to a question in the participants' own words. Nothing is computed from them but how many there are.
#pragma once

#include <string>
#include <vector>

#include "reports/cells/answer_cells.h"

namespace reports {

struct SpokenWords {
    std::string participant;
    std::string fabric;
    std::string condition;
    std::string words;
};

struct WordedCount {
    std::size_t answers = 0;
    std::size_t participants = 0;  ///< who gave at least one
};

struct WordedAnalysis {
    std::vector<WordedCount> conditions;  ///< in the order of the study's conditions
    std::vector<SpokenWords> answers;     ///< by participant, condition and fabric
};

WordedAnalysis collectWords(const StudyData& data, const AnswerCells& cells, const std::string& question);

}  // namespace reports
