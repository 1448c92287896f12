// The parts of statistics.json that belong to one question.
#pragma once

#include "reports/analysis/answer_cells.h"
#include "reports/text/number_text.h"

namespace reports {

/// Adds q1_per_condition, q1_cochran, q1_participant_level and q1_matches_by_rendering of a choice question.
void putChoiceStatistics(Json& statistics, const StudyData& data, const Cells& cells, const std::string& question);

/// Cell means, participants' means, variance and rank tests, pairs and equivalence of a rating question.
Json ratingStatistics(const StudyData& data, const Cells& cells, const std::string& question);

/// Linear mixed model of the ratings with its F test of condition, and logistic mixed model of the choices
/// with its likelihood-ratio test; why there is none where there is none.
Json ratingModelPart(const StudyData& data, const Cells& cells, const std::string& question);
Json choiceModelPart(const StudyData& data, const Cells& cells, const std::string& question);

}  // namespace reports
