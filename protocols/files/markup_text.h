// Text inside HTML and SVG.
#pragma once

#include <string>
#include <string_view>

namespace protocols {

/// Safe between tags and in quoted attributes. Drops control characters, which XML forbids even when escaped.
std::string escapedMarkup(std::string_view text);

}  // namespace protocols
