// The report as one self-contained HTML page: no script, no outside file, fit for printing.
#pragma once

#include <string>

#include "reports/page/report_document.h"

namespace reports {

std::string reportPage(const ReportDocument& document);

/// The page of reportDocument().
std::string reportPage(const StudyAnalysis& analysis, const std::vector<ReportTable>& tables, const std::vector<Figure>& figures,
                       const std::string& logHead = {});

}  // namespace reports
