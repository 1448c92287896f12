// Ratings as ordered categories: the cumulative logit mixed model, which asks nothing of the distances between the values of
// the scale. It stands beside the claims; none of them rests on it.
#pragma once

#include <string>

#include "reports/data/analysis_options.h"
#include "reports/data/study_data.h"
#include "stats/models/crossed_study.h"

namespace reports {

struct OrdinalRatings {
    std::string why;  ///< not empty: the model was not fitted
    double unit = 1;  ///< ratings are rounded to multiples of it
    stats::OrdinalRatingModel fitted;
};

/// Unit to which ratings on this scale are rounded: 1 on scales of 2 to 20 points; elsewhere the smallest of 1, 2 and 5 times a
/// power of ten that makes at most 15 steps.
double roundingUnit(const NumberOnScale& scale);

/// "to whole numbers, halves up", "to multiples of 5, halves up".
std::string roundingWords(double unit);

/// Model of every rating. Depth::Quick leaves it out.
OrdinalRatings ordinalRatings(stats::CrossedStudy ratings, const NumberOnScale& scale, Depth depth);

}  // namespace reports
