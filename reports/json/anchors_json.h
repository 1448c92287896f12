// "anchors" of results.json: floor, reliability and ceiling of each question.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "reports/analysis/study_analysis.h"

namespace reports {

/// An object with "anchors"; empty where the study has no answers to anchors.
nlohmann::ordered_json anchorsMember(const StudyAnalysis& analysis);

}  // namespace reports
