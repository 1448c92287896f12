// statistics.json: every other number of the report, with the names and the nesting of the reference report.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "reports/analysis/study_analysis.h"
#include "reports/json/json_members.h"

namespace reports {

/// A rating question stands at the top level under its id, a choice question under "ID_per_condition", "ID_cochran" and so
/// on in lower case. A question whose key is taken there (an id such as "data") stands under "questions" and its id instead.
nlohmann::ordered_json statisticsJson(const StudyAnalysis& analysis);

/// Gives the text of the file piece by piece.
void writeStatistics(const StudyAnalysis& analysis, const TakeText& take);

}  // namespace reports
