// Text inside HTML and SVG.
#pragma once

#include <string>
#include <string_view>

namespace protocols {

/// Safe between tags and in quoted attributes, and always UTF-8: a byte that begins no character becomes U+FFFD. Drops control
/// characters, which XML forbids even when escaped, and marks that change the direction of the text.
std::string escapedMarkup(std::string_view text);

}  // namespace protocols
