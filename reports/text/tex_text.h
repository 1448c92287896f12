// Text inside LaTeX, for pdfLaTeX with fontenc T1.
#pragma once

#include <string>

namespace reports {

/// Safe anywhere in a document, also as the first cell of a row. Line breaks become spaces. Signs and Greek letters become
/// commands, letters of Latin scripts stay. A character that pdfLaTeX cannot typeset is written as its number: "U+4E2D".
std::string escapedTex(const std::string& text);

/// As escapedTex(), but lines may break inside long words too.
std::string breakableTex(const std::string& text);

/// Width of text in points in Computer Modern of 10 pt: within a few percent, never too small by more.
double texWidth(const std::string& text);

}  // namespace reports
