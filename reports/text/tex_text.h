// Text inside LaTeX.
#pragma once

#include <string>

namespace reports {

/// Safe anywhere in a document, also as the first cell of a row. Line breaks become spaces.
std::string escapedTex(const std::string& text);

}  // namespace reports
