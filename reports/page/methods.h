// How the numbers were computed, at the end of the page.
#pragma once

#include <string>
#include <vector>

#include "reports/analysis/study_analysis.h"

namespace reports {

/// A paragraph each, as HTML. Methods that the study does not use are left out.
std::vector<std::string> methodParagraphs(const StudyAnalysis& analysis);

}  // namespace reports
