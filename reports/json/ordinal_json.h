// The cumulative logit mixed model of a rating question as an object of statistics.json.
#pragma once

#include <string>

#include "reports/analysis/ordinal_ratings.h"
#include "reports/json/json_fields.h"

namespace reports {

/// Effects against the first condition, thresholds and SDs, in log odds. A model that was not fitted has the null "logLik" with
/// its reason.
Json ordinalRatingsJson(const std::string& question, const OrdinalRatings& ratings);

}  // namespace reports
