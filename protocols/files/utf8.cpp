#include "protocols/files/utf8.h"

#include <algorithm>

namespace protocols {

std::size_t utf8Length(std::string_view text)
{
    const auto at = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u; };
    const auto continues = [&](std::size_t i) { return (at(i) & 0xC0u) == 0x80u; };
    const unsigned lead = at(0);
    if (lead < 0x80) return 1;
    if (lead >= 0xC2 && lead <= 0xDF) return continues(1) ? 2 : 0;
    if (lead >= 0xE0 && lead <= 0xEF) {
        const bool overlong = lead == 0xE0 && at(1) < 0xA0;
        const bool surrogate = lead == 0xED && at(1) > 0x9F;
        return continues(1) && continues(2) && !overlong && !surrogate ? 3 : 0;
    }
    if (lead >= 0xF0 && lead <= 0xF4) {
        const bool overlong = lead == 0xF0 && at(1) < 0x90;
        const bool beyond = lead == 0xF4 && at(1) > 0x8F;
        return continues(1) && continues(2) && continues(3) && !overlong && !beyond ? 4 : 0;
    }
    return 0;
}

char32_t utf8Character(std::string_view text)
{
    const std::size_t length = utf8Length(text);
    const auto lead = static_cast<unsigned char>(text[0]);
    if (length <= 1) return lead;
    // The lead byte of a character of n bytes has 7 - n bits of it, each later byte 6.
    char32_t character = lead & ((1U << (7 - length)) - 1);
    for (std::size_t i = 1; i < length; ++i) character = (character << 6) | (static_cast<unsigned char>(text[i]) & 0x3FU);
    return character;
}

std::optional<std::size_t> firstByteThatIsNotUtf8(std::string_view text)
{
    for (std::size_t i = 0; i < text.size();) {
        const std::size_t length = utf8Length(text.substr(i));
        if (length == 0) return i;
        i += length;
    }
    return std::nullopt;
}

std::string_view withoutByteOrderMark(std::string_view text)
{
    constexpr std::string_view mark = "\xEF\xBB\xBF";
    return text.starts_with(mark) ? text.substr(mark.size()) : text;
}

bool isKeptText(std::string_view text)
{
    constexpr std::string_view changed[] = {std::string_view("\0", 1), "\xEF\xBB\xBF", "\xEF\xBF\xBE", "\xEF\xBF\xBF"};
    return std::ranges::none_of(changed, [&](std::string_view one) { return text.find(one) != std::string_view::npos; });
}

std::string inShort(std::string_view text, std::size_t mostBytes)
{
    if (text.size() <= mostBytes) return std::string(text);
    std::size_t end = mostBytes;
    for (int inside = 0; inside < 3 && end > 0 && (text[end] & 0xC0) == 0x80; ++inside) --end;
    return std::string(text.substr(0, end)) + "...";
}

}  // namespace protocols
