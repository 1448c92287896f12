// The figure of speed against accuracy, from milliseconds to people.
#pragma once

#include <vector>

#include "reports/analysis/study_analysis.h"
#include "reports/figures/figure.h"

namespace reports {

/// Empty where the study has no quality factor.
std::vector<Figure> chainFigures(const StudyAnalysis& analysis, FigureWidth width);

}  // namespace reports
