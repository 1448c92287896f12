// The paper's two figures: matches per rendering by condition, ratings by question and condition.
#pragma once

#include <string>
#include <vector>

#include "reports/analysis/study_analysis.h"

namespace reports {

struct Figure {
    std::string name;     ///< of its file, "matches_q1"
    std::string caption;  ///< plain text
    std::string svg;
};

/// Bars with Wilson's 95 % intervals, the chance line, counts on the left and shares on the right.
Figure matchesFigure(const Analysis& analysis, const std::string& question);

/// Means over ratings with the 95 % intervals of the participants' means, all rating questions.
Figure ratingsFigure(const Analysis& analysis);

std::vector<Figure> allFigures(const Analysis& analysis);

}  // namespace reports
