#include "protocols/files/markup_text.h"

namespace protocols {

namespace {

std::string_view entityFor(char c)
{
    switch (c) {
        case '&':
            return "&amp;";
        case '<':
            return "&lt;";
        case '>':
            return "&gt;";
        case '"':
            return "&quot;";
        case '\'':
            return "&#39;";
    }
    return {};
}

bool isForbidden(char c) { return static_cast<unsigned char>(c) < 0x20 && c != '\t' && c != '\n' && c != '\r'; }

}  // namespace

std::string escapedMarkup(std::string_view text)
{
    std::string escaped;
    escaped.reserve(text.size());
    for (const char c : text) {
        if (isForbidden(c)) continue;
        if (const std::string_view entity = entityFor(c); !entity.empty())
            escaped += entity;
        else
            escaped += c;
    }
    return escaped;
}

}  // namespace protocols
