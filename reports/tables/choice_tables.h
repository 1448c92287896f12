// The tables of questions with right and wrong answers.
#pragma once

#include <vector>

#include "reports/analysis/study_analysis.h"
#include "reports/formats/report_table.h"

namespace reports {

std::vector<ReportTable> choiceTables(const StudyAnalysis& analysis);

}  // namespace reports
