#include "protocols/files/id_rule.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>
#include <span>
#include <utility>

#include "protocols/files/errors.h"
#include "protocols/files/utf8.h"

namespace protocols {

namespace {

struct Range {
    char32_t first, last;
};

/// Characters that a reader does not see, but that make two ids look alike or show one in another order. The joiners U+200C and
/// U+200D are not among them: Persian and Hindi are written with them.
constexpr std::array<Range, 17> invisible{{{0x00AD, 0x00AD},
                                           {0x034F, 0x034F},
                                           {0x061C, 0x061C},
                                           {0x115F, 0x1160},
                                           {0x17B4, 0x17B5},
                                           {0x180E, 0x180E},
                                           {0x200B, 0x200B},
                                           {0x200E, 0x200F},
                                           {0x2028, 0x202E},
                                           {0x2060, 0x206F},
                                           {0x2800, 0x2800},
                                           {0x3164, 0x3164},
                                           {0xFEFF, 0xFEFF},
                                           {0xFFA0, 0xFFA0},
                                           {0xFFF9, 0xFFFB},
                                           {0xFFFE, 0xFFFF},
                                           {0xE0000, 0xE007F}}};

/// The joiners, and the selectors that choose a form of the character before them. In an id they hide behind letters and digits
/// of ASCII; words may have them.
constexpr std::array<Range, 4> forms{{{0x180B, 0x180F}, {0x200C, 0x200D}, {0xFE00, 0xFE0F}, {0xE0100, 0xE01EF}}};

bool isControl(char32_t c) { return c < 0x20 || (c >= 0x7F && c < 0xA0); }

bool isIn(std::span<const Range> ranges, char32_t c)
{
    return std::ranges::any_of(ranges, [c](const Range& range) { return c >= range.first && c <= range.last; });
}

bool isWordOfAscii(char32_t c) { return c < 0x80 && std::isalnum(static_cast<unsigned char>(c)) != 0; }

bool isInvisible(char32_t c, char32_t before) { return isIn(invisible, c) || (isWordOfAscii(before) && isIn(forms, c)); }

/// Blanks of Unicode (category Zs).
bool isBlank(char32_t c)
{
    return c == ' ' || c == 0xA0 || c == 0x1680 || (c >= 0x2000 && c <= 0x200A) || c == 0x202F || c == 0x205F || c == 0x3000;
}

std::string faultOfCharacter(char32_t c, char32_t before)
{
    if (isControl(c)) return "holds a control character";
    if (isInvisible(c, before)) return "holds an invisible character";
    if (c == '/' || c == '\\') return "holds a slash or backslash";
    return c == ',' ? "holds a comma" : "";
}

/// Whether tables read the whole id as a missing value.
bool isWordForMissing(std::string_view id)
{
    constexpr std::array<std::string_view, 4> words{"na", "nan", "null", "none"};
    const auto isSame = [](char a, char b) { return std::tolower(static_cast<unsigned char>(a)) == b; };
    return std::ranges::any_of(words, [&](std::string_view word) { return std::ranges::equal(id, word, isSame); });
}

constexpr const char* meansMissing = "stands for a missing value in tables";

/// "U+000B"
std::string numberOfCharacter(char32_t character)
{
    std::array<char, 16> text{};
    std::snprintf(text.data(), text.size(), "U+%04X", static_cast<unsigned>(character));
    return text.data();
}

}  // namespace

std::string idRule()
{
    return "1 to " + std::to_string(longestId) +
           " bytes of UTF-8 without control or invisible characters, slashes, backslashes and commas, that begin with no dot, "
           "dash "
           "or blank and end with no blank";
}

std::string faultOfId(std::string_view id)
{
    if (id.empty()) return "is empty";
    if (id.size() > longestId) return "has " + std::to_string(id.size()) + " bytes";
    if (firstByteThatIsNotUtf8(id)) return "is not UTF-8";
    if (id.front() == '.' || id.front() == '-') return id.front() == '.' ? "begins with a dot" : "begins with a dash";
    bool endsBlank = false;
    char32_t before = 0;
    for (std::size_t at = 0; at < id.size(); at += utf8Length(id.substr(at))) {
        const char32_t character = utf8Character(id.substr(at));
        if (const std::string fault = faultOfCharacter(character, std::exchange(before, character)); !fault.empty()) return fault;
        endsBlank = isBlank(character);
        if (at == 0 && endsBlank) return "begins with a blank";
    }
    return endsBlank ? "ends with a blank" : "";
}

std::string lineRule(std::size_t mostBytes)
{
    return "one line of 1 to " + std::to_string(mostBytes) + " bytes of UTF-8 without control or invisible characters";
}

std::string faultOfLine(std::string_view line, std::size_t mostBytes)
{
    if (line.size() > mostBytes) return "has " + std::to_string(line.size()) + " bytes";
    if (firstByteThatIsNotUtf8(line)) return "is not UTF-8";
    bool hasWords = false;
    for (std::size_t at = 0; at < line.size(); at += utf8Length(line.substr(at))) {
        const char32_t character = utf8Character(line.substr(at));
        if (isControl(character)) return "holds a control character";
        if (isIn(invisible, character)) return "holds an invisible character";
        hasWords = hasWords || !isBlank(character);
    }
    return hasWords ? "" : "is empty";
}

std::string faultOfWords(std::string_view words)
{
    for (std::size_t at = 0; at < words.size(); at += utf8Length(words.substr(at))) {
        if (utf8Length(words.substr(at)) == 0) return "is not UTF-8";
        const char32_t character = utf8Character(words.substr(at));
        const bool isLayout = character == '\n' || character == '\r' || character == '\t';
        const bool isKept = isKeptText(words.substr(at, utf8Length(words.substr(at))));
        if ((isControl(character) && !isLayout) || !isKept) return "holds the character " + numberOfCharacter(character);
    }
    return "";
}

void requireGoodId(std::string_view id, const std::string& named, const std::string& where)
{
    const std::string fault = faultOfId(id);
    if (fault.empty()) return;
    // A longer text would fill the screen.
    const std::string shown = id.size() > longestId ? "an id of " + named : "\"" + std::string(id) + "\"";
    throw badInput({shown + " cannot name " + named + ": it " + fault, where, idRule(), "choose another id"});
}

std::string faultOfNewId(std::string_view id)
{
    const std::string fault = faultOfId(id);
    return fault.empty() && isWordForMissing(id) ? meansMissing : fault;
}

void requireGoodNewId(std::string_view id, const std::string& named, const std::string& where)
{
    requireGoodId(id, named, where);
    if (isWordForMissing(id))
        throw badInput({"\"" + std::string(id) + "\" cannot name " + named + ": it " + meansMissing, where,
                        "another id than NA, NaN, null and None in any case", "choose another id"});
}

}  // namespace protocols
