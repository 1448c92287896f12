// Flags on the data, missing answers, and means without flagged participants.
#pragma once

#include <vector>

#include "reports/analysis/study_analysis.h"
#include "reports/formats/report_table.h"

namespace reports {

std::vector<ReportTable> qualityTables(const StudyAnalysis& analysis);

}  // namespace reports
