// Groups of participants as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "reports/analysis/study_analysis.h"

namespace reports {

/// "participants" by group, and by question the means, the test of the overall means and the contrasts.
nlohmann::ordered_json groupsJson(const StudyAnalysis& analysis);

}  // namespace reports
