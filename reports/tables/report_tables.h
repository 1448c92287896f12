// The one list of the report's tables. The page and the files in tables/ are made from it. So a table that is added to its
// family below appears in both.
#pragma once

#include <vector>

#include "reports/analysis/study_analysis.h"
#include "reports/formats/report_table.h"

namespace reports {

/// Gives every table that the study has, in the order of the page. Names differ without regard to case.
void forEachTable(const StudyAnalysis& analysis, const TakeTable& take);

/// The same tables at once.
std::vector<ReportTable> reportTables(const StudyAnalysis& analysis);

}  // namespace reports
