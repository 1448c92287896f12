// Measured error rates of the claims: over all nulls, and for studies that vary like this one.
#pragma once

#include <vector>

#include "reports/analysis/study_analysis.h"
#include "reports/formats/report_table.h"

namespace reports {

std::vector<ReportTable> falseClaimTables(const StudyAnalysis& analysis);

}  // namespace reports
