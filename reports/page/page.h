// The report as one self-contained HTML page: no script, no outside file, fit for printing.
#pragma once

#include <string>
#include <vector>

#include "reports/analysis/study_analysis.h"
#include "reports/figures/figure.h"
#include "reports/tables/report_table.h"

namespace reports {

/// `logHead`: of the study whose answers these are; empty for answers without a log.
std::string reportPage(const StudyAnalysis& analysis, const std::vector<ReportTable>& tables, const std::vector<Figure>& figures,
                       const std::string& logHead = {});

}  // namespace reports
