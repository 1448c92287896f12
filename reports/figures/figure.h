// A figure of the report with its place on the page.
#pragma once

#include <string>

#include "reports/analysis/choice_analysis.h"
#include "reports/charts/figure_width.h"
#include "reports/data/study_data.h"
#include "reports/text/page_section.h"

namespace reports {

struct Figure {
    std::string name;     ///< name of its file, "matches_Q1"
    std::string caption;  ///< plain text
    std::string svg = {};
    PageSection section = PageSection::Summary;
    std::string question = {};   ///< question of the figure; empty: several questions
    std::string narrowSvg = {};  ///< drawn for one column and for phones
};

/// The caption, with a note on simulated and on scripted participants.
std::string stampedCaption(const StudyData& data, const std::string& caption);

/// For the caption of a figure that shows chance: the conditions that are not tested against it. Empty where all are.
std::string untestedText(const StudyData& data, const ChoiceAnalysis& choices);

}  // namespace reports
