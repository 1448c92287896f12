#include "protocols/files/safe_text.h"

#include <algorithm>

namespace protocols {

namespace {

std::string hexOf(char byte, std::string_view digits)
{
    const auto value = static_cast<unsigned char>(byte);
    return {digits[value >> 4], digits[value & 15]};
}

bool isPlain(char c)
{
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-' || c == '_' || c == '.';
}

/// Length of a mark at the front that changes the direction of the text (U+202A to U+202E, U+2066 to U+2069), or 0.
std::size_t bytesThatTurn(std::string_view text)
{
    const bool isOverride = text.size() >= 3 && text.starts_with("\xE2\x80") && text[2] >= '\xAA' && text[2] <= '\xAE';
    const bool isIsolate = text.size() >= 3 && text.starts_with("\xE2\x81") && text[2] >= '\xA6' && text[2] <= '\xA9';
    return isOverride || isIsolate ? 3 : 0;
}

}  // namespace

std::string printable(std::string_view text)
{
    std::string safe;
    for (std::size_t at = 0; at < text.size(); ++at) {
        const auto byte = static_cast<unsigned char>(text[at]);
        const bool isC1 = byte == 0xc2 && at + 1 < text.size() && static_cast<unsigned char>(text[at + 1]) >= 0x80 &&
                          static_cast<unsigned char>(text[at + 1]) < 0xa0;
        if (const std::size_t turns = bytesThatTurn(text.substr(at)); turns > 0) {
            for (std::size_t i = 0; i < turns; ++i) safe += "\\x" + hexOf(text[at + i], "0123456789abcdef");
            at += turns - 1;
            continue;
        }
        if (text[at] == '\n' || text[at] == '\r')
            safe += ' ';
        else if (byte < 0x20 || byte == 0x7f)
            safe += "\\x" + hexOf(text[at], "0123456789abcdef");
        else if (isC1)
            safe += "\\x" + hexOf(text[++at], "0123456789abcdef");
        else
            safe += text[at];
    }
    return safe;
}

std::string withoutTurns(std::string_view text)
{
    std::string kept;
    while (!text.empty()) {
        const std::size_t turns = bytesThatTurn(text);
        if (turns == 0) kept += text.front();
        text.remove_prefix(turns == 0 ? 1 : turns);
    }
    return kept;
}

std::string shellWord(std::string_view text)
{
    const std::string word = printable(text);
    const auto needsNoQuotes = [](char c) {
        return isPlain(c) || std::string_view("/:@%+=,").find(c) != std::string_view::npos ||
               static_cast<unsigned char>(c) >= 0x80;
    };
    if (!word.empty() && std::all_of(word.begin(), word.end(), needsNoQuotes)) return word;
    std::string quoted = "'";
    for (const char c : word) quoted += c == '\'' ? "'\\''" : std::string(1, c);
    return quoted + "'";
}

std::string printableLines(std::string_view text)
{
    std::string safe;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = text.find('\n', begin);
        safe += printable(text.substr(begin, end - begin));
        if (end == std::string_view::npos) break;
        safe += '\n';
        begin = end + 1;
    }
    return safe;
}

std::string fileNameOf(std::string_view id)
{
    std::string name;
    for (const char c : id)
        name += isPlain(c) && !(name.empty() && c == '.') ? std::string(1, c) : "%" + hexOf(c, "0123456789ABCDEF");
    return name.empty() ? "%" : name;
}

}  // namespace protocols
