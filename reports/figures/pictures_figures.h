// The friction images that the participants felt, by condition and fabric: the paper's figure of signals.
#pragma once

#include <vector>

#include "reports/analysis/study_analysis.h"
#include "reports/figures/figure.h"

namespace reports {

/// "friction_images"; none where the study has no pictures.
std::vector<Figure> picturesFigures(const StudyAnalysis& analysis, FigureWidth width);

}  // namespace reports
