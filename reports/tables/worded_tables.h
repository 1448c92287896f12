// The answers in the participants' own words, one row each.
#pragma once

#include <vector>

#include "reports/analysis/study_analysis.h"
#include "reports/formats/report_table.h"

namespace reports {

std::vector<ReportTable> wordedTables(const StudyAnalysis& analysis);

}  // namespace reports
