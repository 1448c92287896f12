// Forest plots of the contrasts, with the zone of equivalence and both generalisations.
#pragma once

#include <vector>

#include "reports/analysis/study_analysis.h"
#include "reports/figures/figure.h"

namespace reports {

/// One figure for each question with numbers: planned contrasts, or all pairs where they are at most 36.
std::vector<Figure> contrastsFigures(const StudyAnalysis& analysis, FigureWidth width);

}  // namespace reports
