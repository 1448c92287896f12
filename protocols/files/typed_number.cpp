#include "protocols/files/typed_number.h"

#include <array>
#include <string_view>
#include <utility>

#include "protocols/files/utf8.h"

namespace protocols {

namespace {

constexpr char32_t fullWidthZero = 0xFF10;

/// The plain character that an East Asian keyboard gives in full width; others as they are.
char32_t plainOf(char32_t character)
{
    constexpr std::array<std::pair<char32_t, char32_t>, 6> marks{
        {{0xFF0C, '.'}, {0xFF0E, '.'}, {0x3002, '.'}, {',', '.'}, {0xFF0D, '-'}, {0x2212, '-'}}};
    for (const auto& [typed, plain] : marks)
        if (character == typed) return plain;
    const bool isDigit = character >= fullWidthZero && character <= fullWidthZero + 9;
    return isDigit ? '0' + (character - fullWidthZero) : character;
}

std::string_view trimmed(std::string_view text)
{
    constexpr std::string_view blanks = " \t\r\n";
    const auto from = text.find_first_not_of(blanks);
    return from == std::string_view::npos ? "" : text.substr(from, text.find_last_not_of(blanks) - from + 1);
}

bool isDecimal(std::string_view text)
{
    if (!text.empty() && (text.front() == '-' || text.front() == '+')) text.remove_prefix(1);
    const auto point = text.find('.');
    const auto areDigits = [](std::string_view part) {
        return !part.empty() && part.find_first_not_of("0123456789") == std::string_view::npos;
    };
    return areDigits(text.substr(0, point)) && (point == std::string_view::npos || areDigits(text.substr(point + 1)));
}

}  // namespace

std::string typedNumber(const std::string& typed)
{
    const std::string_view text = trimmed(typed);
    if (firstByteThatIsNotUtf8(text)) return std::string(text);
    std::string number;
    for (std::size_t at = 0; at < text.size(); at += utf8Length(text.substr(at))) {
        const char32_t character = plainOf(utf8Character(text.substr(at)));
        if (character > 0x7F) return std::string(text);
        number += static_cast<char>(character);
    }
    return isDecimal(number) ? number : std::string(text);
}

}  // namespace protocols
