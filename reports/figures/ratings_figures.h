// The paper's second figure: ratings by question and condition.
#pragma once

#include <vector>

#include "reports/analysis/study_analysis.h"
#include "reports/figures/figure.h"

namespace reports {

/// Means over ratings with the 95 % intervals of the participants' means. Questions share a figure where they share a scale
/// and their names fit into one legend; further figures are called "ratings_2", "ratings_3" ...
std::vector<Figure> ratingsFigures(const StudyAnalysis& analysis, FigureWidth width);

}  // namespace reports
