// The mixed models of a question as objects of statistics.json.
#pragma once

#include "reports/analysis/model_contrasts.h"
#include "reports/json/json_fields.h"
#include "stats/models/crossed_study.h"

namespace reports {

/// Linear mixed model of ratings, with the F test of condition.
Json ratingModelJson(const stats::RatingModel& fitted);

/// Logistic mixed model of choices, with the likelihood-ratio test of condition.
Json choiceModelJson(const stats::ChoiceModel& fitted);

/// The same for the model with the interactions of participant and fabric with condition.
Json crossedChoiceModelJson(const stats::ChoiceModel& fitted);

/// All pairs of conditions in the linear mixed model, with two one-sided tests at boundsOf() each.
Json modelContrastsJson(const StudyData& data, const std::vector<ModelContrast>& contrasts);

/// Variances and SDs of the linear mixed model.
Json variancesJson(const stats::RatingModel& fitted);

Json leaveOneFabricOutJson(const LeaveOneFabricOut& contrast);

/// "generalises_to" of a model with participants and fabrics: "fabrics_like_these", or null where it saw one of them only.
void putGeneralisation(Json& part, const std::vector<stats::LeftOut>& leftOut);

}  // namespace reports
