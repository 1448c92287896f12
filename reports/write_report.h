// Numbers -> documents: the analysis of a study as one value, and its files.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "reports/data/study_data.h"

namespace reports {

/// The object of results.json (schema vis2hap.results/1), keys in the documented order; every value
/// that does not exist is null with its reason in the object's "why".
nlohmann::ordered_json results(const StudyData& data);

/// statistics.json: what else the report computes, with the names of the reference report.
nlohmann::ordered_json statistics(const StudyData& data);

/// Writes index.html (self-contained), results.json, statistics.json, tables/*.csv and *.tex,
/// figures/*.svg into `folder` (made if missing, earlier report files replaced as a whole).
/// Throws environmentFault where it cannot write; no half-written report is left.
void writeReport(const StudyData& data, const std::filesystem::path& folder);

/// The result table as text for a terminal.
std::string resultTable(const nlohmann::ordered_json& results);

}  // namespace reports
