// The mixed models of a question as objects of statistics.json.
#pragma once

#include "reports/json/json_fields.h"
#include "stats/models/crossed_study.h"

namespace reports {

/// Linear mixed model of ratings, with the F test of condition.
Json ratingModelJson(const stats::RatingModel& fitted);

/// Logistic mixed model of choices, with the likelihood-ratio test of condition.
Json choiceModelJson(const stats::ChoiceModel& fitted);

}  // namespace reports
