// Share correct by response time, for each choice question.
#pragma once

#include <vector>

#include "reports/analysis/study_analysis.h"
#include "reports/figures/figure.h"

namespace reports {

/// One figure for each choice question with response times.
std::vector<Figure> accuracyFigures(const StudyAnalysis& analysis, FigureWidth width);

}  // namespace reports
