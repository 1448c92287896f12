#include "protocols/files/markup_text.h"

#include <algorithm>

#include "protocols/files/utf8.h"

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

constexpr std::string_view replacement = "\xEF\xBF\xBD";  // U+FFFD

}  // namespace

std::string escapedMarkup(std::string_view text)
{
    std::string escaped;
    escaped.reserve(text.size());
    for (std::size_t at = 0, length = 0; at < text.size(); at += std::max<std::size_t>(1, length)) {
        length = utf8Length(text.substr(at));
        const char c = text[at];
        if (isForbidden(c) || (length == 3 && beginsHidden(text.substr(at)))) continue;
        if (length == 0)
            escaped += replacement;
        else if (const std::string_view entity = entityFor(c); !entity.empty())
            escaped += entity;
        else
            escaped += text.substr(at, length);
    }
    return escaped;
}

}  // namespace protocols
