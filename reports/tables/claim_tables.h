// Tables of the claims: contrasts with both generalisations, and choices above chance.
#pragma once

#include <vector>

#include "reports/analysis/study_analysis.h"
#include "reports/tables/report_table.h"

namespace reports {

std::vector<ReportTable> claimTables(const StudyAnalysis& analysis);

}  // namespace reports
