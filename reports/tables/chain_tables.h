// The table of speed against accuracy, from milliseconds to people.
#pragma once

#include <vector>

#include "reports/analysis/study_analysis.h"
#include "reports/formats/report_table.h"

namespace reports {

/// Empty where the study has no quality factor.
std::vector<ReportTable> chainTables(const StudyAnalysis& analysis);

}  // namespace reports
