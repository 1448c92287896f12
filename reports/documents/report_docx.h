// The report as a text document (.docx), made by pandoc where it is installed.
#pragma once

#include <filesystem>
#include <string>

#include "reports/page/report_document.h"

namespace reports {

/// Whether pandoc is on the PATH.
bool hasPandoc();

/// HTML without style and script, whose figures are the files figures/NAME.png in `folder`: what pandoc gets.
std::string plainHtml(const ReportDocument& document);

/// Writes `folder`/report.docx. Throws environmentFault with pandoc's last line where pandoc fails or takes more than a minute.
void writeReportDocx(const ReportDocument& document, const std::filesystem::path& folder);

}  // namespace reports
