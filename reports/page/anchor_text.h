// Sentences on anchors: floor, reliability and ceiling.
#pragma once

#include <string>

#include "reports/analysis/study_analysis.h"

namespace reports {

/// HTML list for the section on ratings; empty without anchors of ratings.
std::string ratingAnchorsText(const StudyAnalysis& analysis);
/// HTML list for the section on matches; empty without repeated choices.
std::string choiceAnchorsText(const StudyAnalysis& analysis);

/// HTML paragraph for the section on methods; empty without anchors.
std::string anchorsMethod(const StudyAnalysis& analysis);

}  // namespace reports
