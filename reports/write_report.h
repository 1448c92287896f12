// The files of a report.
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "reports/analysis/study_analysis.h"
#include "reports/json/report_origin.h"
#include "reports/page/report_document.h"

namespace reports {

/// Writes further forms of the report (reports/documents) into the folder of a draft.
using WriteDocuments = std::function<void(const ReportDocument& document, const std::filesystem::path& folder)>;

/// Writes index.html (self-contained), results.json, statistics.json, tables/*.csv and *.tex, figures/*.svg into `folder`, and
/// what `documents` writes; where the study is not blinded also reproduce/ (scripts/reproduction.h). A blinded report has rounded
/// means and no figures (cells/blinded_means.h). The folder is made if it is missing. An earlier report vanishes as a whole, also
/// documents that this one lacks. Throws environmentFault where it cannot write, badInput where the folder holds somebody's files
/// of these names; no half-written report is left.
void writeReport(const StudyAnalysis& analysis, const std::filesystem::path& folder, const ReportOrigin& origin = {},
                 const WriteDocuments& documents = {});

/// What a report may consist of: names in its folder. Nothing else there is touched.
const std::vector<std::filesystem::path>& entriesOfReports();

/// Throws badInput where the place is a file, or a folder with files of a report's names that no report wrote.
void requireReplaceableReport(const std::filesystem::path& folder);

}  // namespace reports
