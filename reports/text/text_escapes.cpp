#include "reports/text/text_escapes.h"

#include <string_view>
#include <utility>

namespace reports {
namespace {

struct CharacterEscape {
    char character;
    std::string_view text;
};

constexpr CharacterEscape htmlEscapes[] = {{'&', "&amp;"}, {'<', "&lt;"}, {'>', "&gt;"}, {'"', "&quot;"}, {'\'', "&#39;"}};

// "\\" looks for an optional "[...]" or "*" at the start of the next row, so both stand in braces.
constexpr CharacterEscape texEscapes[] = {{'&', "\\&"},
                                          {'%', "\\%"},
                                          {'$', "\\$"},
                                          {'#', "\\#"},
                                          {'_', "\\_"},
                                          {'{', "\\{"},
                                          {'}', "\\}"},
                                          {'~', "\\textasciitilde{}"},
                                          {'^', "\\textasciicircum{}"},
                                          {'\\', "\\textbackslash{}"},
                                          {'<', "$<$"},
                                          {'>', "$>$"},
                                          {'[', "{[}"},
                                          {'*', "{*}"},
                                          {'\n', " "},
                                          {'\r', " "}};

template <std::size_t n>
std::string escaped(const std::string& text, const CharacterEscape (&escapes)[n])
{
    std::string result;
    for (const char c : text) {
        const CharacterEscape* found = nullptr;
        for (const CharacterEscape& escape : escapes)
            if (escape.character == c) found = &escape;
        if (found != nullptr)
            result += found->text;
        else
            result += c;
    }
    return result;
}

}  // namespace

std::string escapedHtml(const std::string& text) { return escaped(text, htmlEscapes); }

std::string escapedTex(const std::string& text) { return escaped(text, texEscapes); }

}  // namespace reports
