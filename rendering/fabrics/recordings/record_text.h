// Text of recordings: encoding, lines and cells.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace rendering::fabrics {

/// Converts Latin-1 to UTF-8 and removes carriage returns.
std::string asUtf8(std::string_view latin1);
/// Returns UTF-8 unchanged and converts other bytes from Latin-1. For names in messages, pictures and JSON.
std::string readable(const std::string& text);
/// Lines of a text; the text must outlive them.
std::vector<std::string_view> linesOf(std::string_view text);
std::vector<std::string_view> splitAt(std::string_view line, char separator);

}  // namespace rendering::fabrics
