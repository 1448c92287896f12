// results.json: the object of schema vis2hap.results/2, with its keys in the documented order.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "reports/analysis/study_analysis.h"

namespace reports {

/// Every value that does not exist is null, with its reason in the object's "why".
nlohmann::ordered_json resultsJson(const StudyAnalysis& analysis);

/// The text of the file.
std::string resultsText(const StudyAnalysis& analysis);

/// Whether a report of this or an earlier version wrote the file.
bool isResultsFile(const std::filesystem::path& file);

}  // namespace reports
