// The tables of pairs of conditions: differences, and equivalence.
#pragma once

#include <vector>

#include "reports/analysis/study_analysis.h"
#include "reports/tables/report_table.h"

namespace reports {

std::vector<ReportTable> pairTables(const StudyAnalysis& analysis);

}  // namespace reports
