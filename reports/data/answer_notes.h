// What a person should know about a table of answers that was read.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "reports/data/answer_columns.h"
#include "reports/data/answer_numbers.h"
#include "reports/data/answer_rows.h"
#include "reports/data/study_data.h"

namespace reports {

/// What the cells of a table showed.
struct FoundInCells {
    bool hasOtherScale = false;                     ///< ratings of an export are outside the scale that nobody named
    std::map<std::string, ScoresOfAnswers> scores;  ///< of each question
};

/// Sentences on what was found in the table, and on what is not analysed. `where` names the file.
std::vector<std::string> answerNotes(const AnswerRows& rows, const AnswerColumns& columns, const StudyData& data,
                                     const FoundInCells& found, const std::string& where);

}  // namespace reports
