// Generated against measured signals: the controls, the differences from them, t tests and equivalence tests.
#pragma once

#include <vector>

#include "reports/analysis/study_analysis.h"
#include "reports/formats/report_table.h"

namespace reports {

std::vector<ReportTable> signalTables(const StudyAnalysis& analysis);

}  // namespace reports
