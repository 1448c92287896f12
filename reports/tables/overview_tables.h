// The study at a glance: one row a condition, the main number of every question.
#pragma once

#include <string>
#include <vector>

#include "reports/analysis/study_analysis.h"
#include "reports/formats/report_table.h"

namespace reports {

/// Of a blinded study rounded means; none before all participants have finished.
std::vector<ReportTable> overviewTables(const StudyAnalysis& analysis);

/// The same as text for a terminal; of a blinded study also the sentence that says what is left out.
std::string overviewText(const StudyAnalysis& analysis);

}  // namespace reports
