// The report as a PDF of A4 pages, made by Qt alone.
#pragma once

#include <filesystem>

#include "reports/page/report_document.h"

namespace reports {

/// Writes the whole report. Folded tables are open. A heading or a caption never stands alone at the foot of a page, the head of
/// a table is repeated on every page, and every page names the report and, where there are tags, the kind of data. Needs a
/// QGuiApplication. Throws environmentFault where it cannot write, or no font is installed.
void writeReportPdf(const ReportDocument& document, const std::filesystem::path& file);

}  // namespace reports
