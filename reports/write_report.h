// The files of a report.
#pragma once

#include <filesystem>

#include "reports/analysis/study_analysis.h"
#include "reports/json/report_origin.h"

namespace reports {

/// Writes index.html (self-contained), results.json, statistics.json, tables/*.csv and *.tex, figures/*.svg into `folder`. The
/// folder is made if it is missing, and the files of an earlier report are replaced as a whole. Throws environmentFault where it
/// cannot write, badInput where the folder holds somebody's files of these names; no half-written report is left.
void writeReport(const StudyAnalysis& analysis, const std::filesystem::path& folder, const ReportOrigin& origin = {});

/// Throws badInput where the place is a file, or a folder with files of a report's names that no report wrote.
void requireReplaceableReport(const std::filesystem::path& folder);

}  // namespace reports
