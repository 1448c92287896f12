// The report as a LaTeX document for pdfLaTeX, which inputs the tables and figures beside it.
#pragma once

#include <string>

#include "reports/page/report_document.h"

namespace reports {

/// Text of report.tex, to be compiled in the folder of the report: pdflatex report.tex, twice. Uses array, booktabs, longtable,
/// graphicx, geometry and hyperref of texlive-latex-recommended.
std::string reportTex(const ReportDocument& document);

/// HTML text of a report (report_document.h) as LaTeX.
std::string texOfHtml(const std::string& html);

}  // namespace reports
