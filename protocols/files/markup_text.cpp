#include "protocols/files/markup_text.h"

#include <algorithm>

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

/// U+FFFE and U+FFFF, which XML does not have, and marks that show the numbers behind them in another order.
bool beginsHidden(std::string_view text)
{
    constexpr std::string_view hidden[] = {"\xEF\xBF\xBE", "\xEF\xBF\xBF", "\xE2\x80\xAA", "\xE2\x80\xAB",
                                           "\xE2\x80\xAC", "\xE2\x80\xAD", "\xE2\x80\xAE", "\xE2\x81\xA6",
                                           "\xE2\x81\xA7", "\xE2\x81\xA8", "\xE2\x81\xA9"};
    return std::ranges::any_of(hidden, [&](std::string_view one) { return text.starts_with(one); });
}

}  // namespace

std::string escapedMarkup(std::string_view text)
{
    std::string escaped;
    escaped.reserve(text.size());
    for (std::size_t at = 0; at < text.size(); ++at) {
        const char c = text[at];
        if (isForbidden(c)) continue;
        if (static_cast<unsigned char>(c) >= 0xE2 && beginsHidden(text.substr(at))) {
            at += 2;
            continue;
        }
        if (const std::string_view entity = entityFor(c); !entity.empty())
            escaped += entity;
        else
            escaped += c;
    }
    return escaped;
}

}  // namespace protocols
