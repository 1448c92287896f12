// results.json: the object of schema vis2hap.results/2, with its keys in the documented order.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

#include "reports/analysis/study_analysis.h"
#include "reports/json/json_members.h"
#include "reports/json/report_origin.h"

namespace reports {

/// Every value that does not exist is null, with its reason in the object's "why". Answers of a study carry its origin.
nlohmann::ordered_json resultsJson(const StudyAnalysis& analysis, const ReportOrigin& origin = {});

/// Gives the text of the file piece by piece.
void writeResults(const StudyAnalysis& analysis, const ReportOrigin& origin, const TakeText& take);

/// Whether a report of this or an earlier version wrote the file.
bool isResultsFile(const std::filesystem::path& file);

}  // namespace reports
