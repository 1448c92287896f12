// Every participant's mean under every condition, with within-participant intervals.
#pragma once

#include <vector>

#include "reports/analysis/study_analysis.h"
#include "reports/figures/figure.h"

namespace reports {

/// One figure for each rating question.
std::vector<Figure> participantsFigures(const StudyAnalysis& analysis, FigureWidth width);

}  // namespace reports
