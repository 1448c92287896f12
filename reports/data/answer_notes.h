// What a person should know about a table of answers that was read.
#pragma once

#include <string>
#include <vector>

#include "reports/data/answer_columns.h"
#include "reports/data/answer_rows.h"
#include "reports/data/study_data.h"

namespace reports {

/// Sentences on what was found in the table, and on what is not analysed. `where` names the file. `hasOtherScale`: ratings lie
/// outside a scale that nobody named.
std::vector<std::string> answerNotes(const AnswerRows& rows, const AnswerColumns& columns, const StudyData& data,
                                     bool hasOtherScale, const std::string& where);

}  // namespace reports
