#include "protocols/secrets/new_passphrase.h"

#include <algorithm>

#include "protocols/files/utf8.h"

namespace protocols {

namespace {

/// A byte that begins no character counts as one.
std::u32string codePointsOf(std::string_view text)
{
    std::u32string points;
    while (!text.empty()) {
        points += utf8Character(text);
        text.remove_prefix(std::max<std::size_t>(1, utf8Length(text)));
    }
    return points;
}

/// Those of ASCII, and those that ISO 8859 added (U+0080 to U+009F).
bool isControlCharacter(char32_t c) { return c < 0x20 || (c >= 0x7F && c < 0xA0); }

}  // namespace

std::optional<PassphraseFault> faultOfNewPassphrase(std::string_view text)
{
    const std::u32string points = codePointsOf(text);
    if (!points.empty() && std::ranges::all_of(points, [](char32_t c) { return c <= U' '; })) return PassphraseFault::OnlyBlanks;
    if (std::ranges::any_of(points, isControlCharacter)) return PassphraseFault::ControlCharacter;
    if (points.size() < shortestPassphrase) return PassphraseFault::TooShort;
    return std::nullopt;
}

std::string withoutLineEnd(std::string text)
{
    for (const char end : {'\n', '\r'})
        if (text.ends_with(end)) text.pop_back();
    return text;
}

}  // namespace protocols
