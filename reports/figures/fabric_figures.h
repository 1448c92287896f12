// Answers by fabric: which fabric was taken for which, and how each fabric was rated under each condition.
#pragma once

#include <vector>

#include "reports/analysis/study_analysis.h"
#include "reports/figures/figure.h"

namespace reports {

/// "confusion_Q1" for every choice question whose answers name fabrics; "by_fabric_Q2" for every rating question. None for a
/// study of more than 40 fabrics, whose cells nobody could read.
std::vector<Figure> fabricFigures(const StudyAnalysis& analysis, FigureWidth width);

}  // namespace reports
