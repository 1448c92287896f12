// Tables of effect sizes and reliability, variance components, and Bayes factors.
#pragma once

#include <vector>

#include "reports/analysis/study_analysis.h"
#include "reports/formats/report_table.h"

namespace reports {

std::vector<ReportTable> effectTables(const StudyAnalysis& analysis);

}  // namespace reports
