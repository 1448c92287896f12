// The text on the plan of the study: the registration, and what was done otherwise.
#pragma once

#include <string>
#include <vector>

#include "reports/analysis/study_analysis.h"

namespace reports {

/// HTML before the tables of the section.
std::string planLead(const StudyAnalysis& analysis);

/// Sentences for the summary, as HTML: the registration, and the number of deviations. None where no plan is known.
std::vector<std::string> planFindings(const StudyAnalysis& analysis);

/// What states the bounds of equivalence: "The protocol", "Version 2 of the protocol", "The registered plan".
std::string planSource(const StudyData& data);

}  // namespace reports
