// The answers to a question as the mixed models take them: condition beside participants and fabrics, so that a result holds
// for new participants and new fabrics.
#pragma once

#include <string>

#include "reports/cells/answer_cells.h"
#include "stats/models/crossed_study.h"

namespace reports {

/// Every answer with a number, in the order of conditions, participants and fabrics. Where a cell has several answers and some
/// are missing: those in repetitions that the participant answered, for the fabric, under every condition that has answers there.
/// No model has the repetition or the instruction as a term, so their differences would look like those of conditions.
stats::CrossedStudy crossedAnswers(const StudyData& data, const AnswerCells& cells, const std::string& question);

/// The same with one value for each cell, the mean of these repetitions.
stats::CrossedStudy crossedCells(const StudyData& data, const AnswerCells& cells, const std::string& question);

/// The answers behind the values of crossedCells().
struct AnswersOfCells {
    double perCell = 1;  ///< harmonic mean of their numbers; where units count equally, so many as have the variance of the mean
    double sd = 0;       ///< of answers about the mean of their cell; 0 where no cell has two
};

AnswersOfCells answersOfCells(const StudyData& data, const AnswerCells& cells, const std::string& question);

}  // namespace reports
