// The "chain" of results.json: speed against accuracy, from milliseconds to people.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "reports/analysis/study_analysis.h"

namespace reports {

/// {"chain": [...]}, or null with the reason where the study has no quality factor.
nlohmann::ordered_json chainMember(const StudyAnalysis& analysis);

}  // namespace reports
