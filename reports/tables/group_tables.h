// Tables of groups of participants.
#pragma once

#include <vector>

#include "reports/analysis/study_analysis.h"
#include "reports/formats/report_table.h"

namespace reports {

/// Means by group and condition, and tests of the groups; none where there are no groups.
std::vector<ReportTable> groupTables(const StudyAnalysis& analysis);

}  // namespace reports
