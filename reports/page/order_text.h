// Sentences on order, learning and fatigue.
#pragma once

#include <string>
#include <vector>

#include "reports/analysis/study_analysis.h"

namespace reports {

/// One sentence (HTML) for each change whose 95 % interval excludes 0, and then how many were tested. Empty without such a
/// change.
std::vector<std::string> orderSentences(const StudyAnalysis& analysis);

}  // namespace reports
