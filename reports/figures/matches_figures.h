// The paper's first figure, for every choice question: matches per rendering by condition.
#pragma once

#include <vector>

#include "reports/analysis/study_analysis.h"
#include "reports/figures/figure.h"

namespace reports {

/// Bars of the mean share with its 95 % interval over participants and fabrics, or over participants where fabrics cannot be a
/// sample. The chance line where some condition is tested against it. Counts on the left axis, shares on the right.
std::vector<Figure> matchesFigures(const StudyAnalysis& analysis, FigureWidth width);

}  // namespace reports
