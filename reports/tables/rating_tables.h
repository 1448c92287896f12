// The tables of rating questions.
#pragma once

#include <vector>

#include "reports/analysis/study_analysis.h"
#include "reports/formats/report_table.h"

namespace reports {

std::vector<ReportTable> ratingTables(const StudyAnalysis& analysis);

}  // namespace reports
