// The part of statistics.json that belongs to a rating question.
#pragma once

#include "reports/analysis/rating_analysis.h"
#include "reports/json/json_fields.h"

namespace reports {

/// Cell means, participants' means, variance and rank tests, the mixed model, pairs and equivalence. "on_common_fabrics" has the
/// tests of the page where answers are missing: there they differ from those that the reference numbers define.
Json ratingStatistics(const StudyData& data, const RatingAnalysis& ratings);

}  // namespace reports
