// The paper's first figure, for every choice question: matches per rendering by condition.
#pragma once

#include <vector>

#include "reports/analysis/study_analysis.h"
#include "reports/figures/figure.h"

namespace reports {

/// Bars with Wilson's 95 % intervals and the chance line; counts on the left axis, shares on the right.
std::vector<Figure> matchesFigures(const StudyAnalysis& analysis, FigureWidth width);

}  // namespace reports
