// The forms of a report beside its page: PDF, LaTeX and text document, and figures for papers.
#pragma once

#include <functional>
#include <string>

#include "reports/write_report.h"

namespace reports {

/// Writes report.pdf, report.tex and figures/*.pdf, and report.docx where pandoc is installed. `note` gets one line on how to get
/// what is missing. Needs a QGuiApplication; a report must be written in the thread of it.
WriteDocuments allDocuments(const std::function<void(const std::string& line)>& note = {});

}  // namespace reports
