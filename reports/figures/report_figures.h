// The one list of the report's figures. The page and the files in figures/ are made from it. So a figure that is added to its
// family below appears in both.
#pragma once

#include <vector>

#include "reports/analysis/study_analysis.h"
#include "reports/figures/figure.h"

namespace reports {

/// Folder inside figures/ with the figures for one column.
inline constexpr const char* oneColumnFolder = "88mm";

/// Every figure that the study has, in the order of the page. Names differ without regard to case.
std::vector<Figure> reportFigures(const StudyAnalysis& analysis);

}  // namespace reports
