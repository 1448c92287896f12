// The report as one self-contained HTML page: no script, no outside file, prints well.
#pragma once

#include <string>
#include <vector>

#include "reports/analysis/study_analysis.h"
#include "reports/figures/report_figures.h"

namespace reports {

std::string page(const Analysis& analysis, const std::vector<Figure>& figures);

/// The style sheet of the page.
std::string pageStyle();

/// The methods, a paragraph each, as HTML.
std::vector<std::string> methodParagraphs(const Analysis& analysis);

/// What came out, a sentence each, as HTML.
std::vector<std::string> findings(const Analysis& analysis);

}  // namespace reports
