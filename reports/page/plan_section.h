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

/// The bounds of equivalence and what states them, or which default they are, as HTML.
std::string boundsSentence(const StudyData& data);
/// The same without the bounds.
std::string boundsLead(const StudyData& data);

/// What states the planned contrasts, within a sentence: "the protocol", "the option --planned".
std::string contrastsSource(const StudyData& data);

}  // namespace reports
