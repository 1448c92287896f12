// The content of a report in its order, before it takes the form of a page, a PDF, a LaTeX document or a text document.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "reports/analysis/study_analysis.h"
#include "reports/figures/figure.h"
#include "reports/formats/report_table.h"
#include "reports/text/page_section.h"

namespace reports {

/// A sentence that stands before everything else.
struct DocumentNotice {
    std::string html;
    bool isWarning = false;  ///< the numbers are not what a reader would take them for
};

/// Words about the kind of data that stand at the head of every section, so that no part can be quoted without them.
struct DocumentTag {
    std::string text;  ///< "SIMULATED participants"
    bool isWarning = true;
};

using DocumentItem = std::variant<const Figure*, const ReportTable*>;

struct DocumentSection {
    SectionHeading heading;
    std::string leadHtml;
    std::vector<DocumentItem> items;  ///< figures and tables of the whole study, then those of each question
    std::string endHtml;
};

/// Refers to tables and figures that must outlive it. Text called `html` uses p, b, i, code, sub, sup, span, br, ul, li, a, and
/// the elements of html_parts.h; it is well-formed but for br and named entities.
struct ReportDocument {
    std::string title;  ///< plain text, as are the next two
    std::string lede;
    std::vector<DocumentTag> tags;
    std::vector<DocumentNotice> notices;
    std::vector<DocumentSection> sections;
    std::string footerHtml;
};

/// `logHead`: of the study whose answers these are; empty for answers without a log. Sections without content are left out.
ReportDocument reportDocument(const StudyAnalysis& analysis, const std::vector<ReportTable>& tables,
                              const std::vector<Figure>& figures, const std::string& logHead = {});

}  // namespace reports
