// What displays measured of the fingers, and what operators' latencies are, as parts of results.json.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "reports/analysis/study_analysis.h"
#include "reports/json/json_fields.h"

namespace reports {

/// "touch": speed and force by condition; null with its reason where there are no samples.
Json touchMember(const StudyAnalysis& analysis);

/// "operator_latency": one row for each run of the latency task; null with its reason where there is none.
Json operatorLatencyMember(const StudyData& data);

}  // namespace reports
