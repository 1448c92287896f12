#include "reports/text/tex_text.h"

#include <algorithm>
#include <iterator>
#include <string_view>

namespace reports {
namespace {

struct CharacterEscape {
    char character;
    std::string_view text;
};

// "\\" looks for an optional "[...]" or "*" at the start of the next row, so both stand in braces.
constexpr CharacterEscape escapes[] = {{'&', "\\&"},
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

}  // namespace

std::string escapedTex(const std::string& text)
{
    std::string result;
    for (const char c : text) {
        const auto* found =
            std::find_if(std::begin(escapes), std::end(escapes), [&](const CharacterEscape& one) { return one.character == c; });
        if (found != std::end(escapes))
            result += found->text;
        else
            result += c;
    }
    return result;
}

}  // namespace reports
