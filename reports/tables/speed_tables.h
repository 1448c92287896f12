// Speed and accuracy of the matching task by condition.
#pragma once

#include <vector>

#include "reports/analysis/study_analysis.h"
#include "reports/tables/report_table.h"

namespace reports {

std::vector<ReportTable> speedTables(const StudyAnalysis& analysis);

}  // namespace reports
