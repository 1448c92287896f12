// Text of any origin made safe for the formats of the report.
#pragma once

#include <string>

namespace reports {

/// For HTML and XML: in elements, and in attributes between quotes of either kind.
std::string escapedHtml(const std::string& text);

/// For LaTeX, also as the first cell of a row. Line breaks become spaces.
std::string escapedTex(const std::string& text);

}  // namespace reports
