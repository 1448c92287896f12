// Tables of the fingers on the display and of the operators' latencies.
#pragma once

#include <vector>

#include "reports/analysis/study_analysis.h"
#include "reports/formats/report_table.h"

namespace reports {

std::vector<ReportTable> touchTables(const StudyAnalysis& analysis);

}  // namespace reports
