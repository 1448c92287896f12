// The parts of statistics.json that belong to a choice question.
#pragma once

#include <string>
#include <vector>

#include "reports/analysis/choice_analysis.h"
#include "reports/json/json_fields.h"

namespace reports {

/// The keys that putChoiceStatistics writes for the question.
std::vector<std::string> choiceStatisticsKeys(const std::string& question);

/// Adds the keys "q1_per_condition", "q1_cochran" and so on.
void putChoiceStatistics(Json& statistics, const StudyData& data, const std::string& question, const ChoiceAnalysis& choices);

}  // namespace reports
