// The results in sentences, at the top of the page.
#pragma once

#include <string>
#include <vector>

#include "reports/analysis/study_analysis.h"

namespace reports {

/// One sentence or a few for each result, as HTML.
std::vector<std::string> findings(const StudyAnalysis& analysis);

}  // namespace reports
