// The tables of rating questions under the cumulative logit mixed model.
#pragma once

#include <vector>

#include "reports/analysis/study_analysis.h"
#include "reports/formats/report_table.h"

namespace reports {

/// None where every question's model was left out by --quick.
std::vector<ReportTable> ordinalTables(const StudyAnalysis& analysis);

}  // namespace reports
