// How often the tests of this report reject when there is no true effect, as measured by simulation.
#pragma once

#include <vector>

#include "reports/analysis/study_analysis.h"
#include "reports/formats/report_table.h"

namespace reports {

std::vector<ReportTable> measuredSizeTables(const StudyAnalysis& analysis);

}  // namespace reports
