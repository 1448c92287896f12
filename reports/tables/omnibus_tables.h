// All conditions at once: one row a question and test.
#pragma once

#include <vector>

#include "reports/analysis/study_analysis.h"
#include "reports/formats/report_table.h"

namespace reports {

std::vector<ReportTable> omnibusTables(const StudyAnalysis& analysis);

}  // namespace reports
