// Tables of the claims: contrasts with both generalisations, and choices above chance.
#pragma once

#include "reports/analysis/study_analysis.h"
#include "reports/formats/report_table.h"

namespace reports {

void claimTables(const StudyAnalysis& analysis, const TakeTable& take);

}  // namespace reports
