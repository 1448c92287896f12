// Planned beside done: one row an item of the plan, and one row a planned contrast.
#pragma once

#include <vector>

#include "reports/analysis/study_analysis.h"
#include "reports/formats/report_table.h"

namespace reports {

/// Empty where no plan is known.
std::vector<ReportTable> planTables(const StudyAnalysis& analysis);

}  // namespace reports
