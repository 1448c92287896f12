// Speed and accuracy of the choice questions: by condition, between conditions, and by response time.
#pragma once

#include <vector>

#include "reports/analysis/study_analysis.h"
#include "reports/formats/report_table.h"

namespace reports {

std::vector<ReportTable> speedTables(const StudyAnalysis& analysis);

}  // namespace reports
