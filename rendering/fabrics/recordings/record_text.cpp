#include "rendering/fabrics/recordings/record_text.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace rendering::fabrics {

namespace {

/// Removes the characters that a JSON string may not contain, so that only its encoding is tested.
std::string quotable(std::string text)
{
    std::erase_if(text, [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == '"' || c == '\\'; });
    return text;
}

}  // namespace

std::string asUtf8(std::string_view latin1)
{
    std::string text;
    text.reserve(latin1.size());
    for (const char c : latin1) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte >= 0x80) {
            text += char(0xC0 | (byte >> 6));
            text += char(0x80 | (byte & 0x3F));
        } else if (c != '\r') {
            text += c;
        }
    }
    return text;
}

std::string readable(const std::string& text)
{
    // nlohmann's decoder recognises every malformed sequence, so a second decoder is not needed.
    return nlohmann::json::accept("\"" + quotable(text) + "\"") ? text : asUtf8(text);
}

std::vector<std::string_view> linesOf(std::string_view text)
{
    std::vector<std::string_view> lines;
    while (!text.empty()) {
        const auto end = std::min(text.find('\n'), text.size());
        lines.push_back(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return lines;
}

std::vector<std::string_view> splitAt(std::string_view line, char separator)
{
    std::vector<std::string_view> cells;
    while (true) {
        const auto at = line.find(separator);
        cells.push_back(line.substr(0, at));
        if (at == std::string_view::npos) return cells;
        line.remove_prefix(at + 1);
    }
}

}  // namespace rendering::fabrics
