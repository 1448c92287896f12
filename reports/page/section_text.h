// The text of a section, in addition to its figures and tables.
#pragma once

#include <string>

#include "reports/analysis/study_analysis.h"
#include "reports/text/page_section.h"

namespace reports {

/// HTML before the figures and tables.
std::string sectionLead(PageSection section, const StudyAnalysis& analysis);

/// HTML after the figures and tables.
std::string sectionEnd(PageSection section, const StudyAnalysis& analysis);

/// Whether the section appears even without a figure or table.
bool standsAlone(PageSection section);

}  // namespace reports
