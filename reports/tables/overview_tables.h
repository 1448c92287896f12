// The study at a glance: one row a condition, the main number of every question.
#pragma once

#include <string>
#include <vector>

#include "reports/analysis/study_analysis.h"
#include "reports/formats/report_table.h"

namespace reports {

std::vector<ReportTable> overviewTables(const StudyAnalysis& analysis);

/// The same as text for a terminal.
std::string overviewText(const StudyAnalysis& analysis);

}  // namespace reports
