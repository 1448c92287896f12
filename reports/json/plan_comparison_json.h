// The object "preregistration" of results.json.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "reports/analysis/study_analysis.h"

namespace reports {

/// The first registration, its amendments, and the items in which the study differs from its plan. Where nothing is
/// registered, the fields are null with their reason.
nlohmann::ordered_json preregistrationJson(const StudyAnalysis& analysis);

}  // namespace reports
