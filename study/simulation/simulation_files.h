// The files of a simulation in memory: results.json in the form of a report, and tables. Names and captions say "simulated".
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "reports/analysis/study_analysis.h"
#include "reports/formats/table.h"

namespace study::simulation {

/// "simulated_q1_matches", "simulated_comparisons_q2", ...
std::vector<reports::Table> simulationTables(const reports::StudyAnalysis& analysis);

/// Throws badInput where the folder holds files that no simulation in memory wrote, such as a report of a study.
void requireReplaceableSimulation(const std::filesystem::path& folder);

/// Writes results.json, tables/*.csv and tables/*.tex. Those of an earlier simulation are replaced as a whole.
void writeSimulation(const reports::StudyAnalysis& analysis, const std::string& madeWith, const std::filesystem::path& folder);

}  // namespace study::simulation
