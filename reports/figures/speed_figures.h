// Figures of speed against accuracy: conditions, and instructions where blocks give them.
#pragma once

#include <vector>

#include "reports/analysis/study_analysis.h"
#include "reports/figures/figure.h"

namespace reports {

/// "speed_accuracy_Q1" for every choice question with times, and "instructions_Q1" where its blocks instruct.
std::vector<Figure> speedFigures(const StudyAnalysis& analysis, FigureWidth width);

}  // namespace reports
