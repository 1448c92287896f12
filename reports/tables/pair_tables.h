// The tables of pairs of conditions: differences, and equivalence.
#pragma once

#include "reports/analysis/study_analysis.h"
#include "reports/formats/report_table.h"

namespace reports {

void pairTables(const StudyAnalysis& analysis, const TakeTable& take);

}  // namespace reports
