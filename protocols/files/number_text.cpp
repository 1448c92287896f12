#include "protocols/files/number_text.h"

#include <charconv>
#include <cmath>

namespace protocols {

std::string shortest(double value)
{
    char buffer[40];
    const auto [end, problem] = std::to_chars(buffer, buffer + sizeof buffer, value);
    return std::string(buffer, problem == std::errc{} ? end : buffer);
}

std::string fixed(double value, int decimals)
{
    constexpr double longest = 1e12;  // nobody reads more digits
    char buffer[128];
    const auto form = std::fabs(value) < longest ? std::chars_format::fixed : std::chars_format::scientific;
    const auto end =
        std::to_chars(buffer, buffer + sizeof buffer, value, form, form == std::chars_format::fixed ? decimals : 2).ptr;
    std::string text(buffer, end);
    if (text.starts_with('-') && text.find_first_not_of("-0.") == std::string::npos) text.erase(0, 1);
    return text;
}

std::optional<double> numberIn(std::string_view text)
{
    text = withoutBlanks(text);
    if (text.starts_with('+')) text.remove_prefix(1);
    double value = 0;
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (problem != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
    return value;
}

std::string_view withoutBlanks(std::string_view text)
{
    constexpr std::string_view blanks = " \t\r\n";
    const auto first = text.find_first_not_of(blanks);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

}  // namespace protocols
