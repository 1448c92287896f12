// Order, learning and fatigue: trends over trials and sittings, and contrasts without the trend.
#pragma once

#include <vector>

#include "reports/analysis/study_analysis.h"
#include "reports/formats/report_table.h"

namespace reports {

/// None where the answers do not say when they were given.
std::vector<ReportTable> orderTables(const StudyAnalysis& analysis);

}  // namespace reports
