// The answers to a question as the mixed models take them: condition beside participants and fabrics, so that a result holds
// for new participants and new fabrics.
#pragma once

#include <string>

#include "reports/cells/answer_cells.h"
#include "stats/models/crossed_study.h"

namespace reports {

/// Every answer with a number, in the order of conditions, participants and fabrics.
stats::CrossedStudy crossedAnswers(const StudyData& data, const AnswerCells& cells, const std::string& question);

/// The same with one value for each cell, the mean of its repetitions.
stats::CrossedStudy crossedCells(const StudyData& data, const AnswerCells& cells, const std::string& question);

}  // namespace reports
