#include "reports/text/tex_text.h"

#include <algorithm>
#include <cstdio>
#include <iterator>
#include <string_view>

#include "protocols/files/utf8.h"

namespace reports {
namespace {

struct CharacterEscape {
    char32_t character;
    std::string_view tex;
};

// "\\" looks for an optional "[...]" or "*" at the start of the next row, so both stand in braces. Sorted by character.
constexpr CharacterEscape escapes[] = {{U'\t', " "},
                                       {U'\n', " "},
                                       {U'\r', " "},
                                       {U'#', "\\#"},
                                       {U'$', "\\$"},
                                       {U'%', "\\%"},
                                       {U'&', "\\&"},
                                       {U'*', "{*}"},
                                       {U'<', "$<$"},
                                       {U'>', "$>$"},
                                       {U'[', "{[}"},
                                       {U'\\', "\\textbackslash{}"},
                                       {U'^', "\\textasciicircum{}"},
                                       {U'_', "\\_"},
                                       {U'{', "\\{"},
                                       {U'}', "\\}"},
                                       {U'~', "\\textasciitilde{}"},
                                       {0xA0, "~"},
                                       {0xA7, "\\S{}"},
                                       {0xB0, "$^\\circ$"},
                                       {0xB1, "$\\pm$"},
                                       {0xB2, "$^2$"},
                                       {0xB3, "$^3$"},
                                       {0xB5, "$\\mu$"},
                                       {0xB7, "$\\cdot$"},
                                       {0xB9, "$^1$"},
                                       {0xBD, "$\\frac12$"},
                                       {0xD7, "$\\times$"},
                                       {0xF7, "$\\div$"},
                                       {0x391, "A"},
                                       {0x393, "$\\Gamma$"},
                                       {0x394, "$\\Delta$"},
                                       {0x398, "$\\Theta$"},
                                       {0x39B, "$\\Lambda$"},
                                       {0x3A0, "$\\Pi$"},
                                       {0x3A3, "$\\Sigma$"},
                                       {0x3A6, "$\\Phi$"},
                                       {0x3A8, "$\\Psi$"},
                                       {0x3A9, "$\\Omega$"},
                                       {0x3B1, "$\\alpha$"},
                                       {0x3B2, "$\\beta$"},
                                       {0x3B3, "$\\gamma$"},
                                       {0x3B4, "$\\delta$"},
                                       {0x3B5, "$\\varepsilon$"},
                                       {0x3B6, "$\\zeta$"},
                                       {0x3B7, "$\\eta$"},
                                       {0x3B8, "$\\theta$"},
                                       {0x3B9, "$\\iota$"},
                                       {0x3BA, "$\\kappa$"},
                                       {0x3BB, "$\\lambda$"},
                                       {0x3BC, "$\\mu$"},
                                       {0x3BD, "$\\nu$"},
                                       {0x3BE, "$\\xi$"},
                                       {0x3BF, "o"},
                                       {0x3C0, "$\\pi$"},
                                       {0x3C1, "$\\rho$"},
                                       {0x3C3, "$\\sigma$"},
                                       {0x3C4, "$\\tau$"},
                                       {0x3C5, "$\\upsilon$"},
                                       {0x3C6, "$\\varphi$"},
                                       {0x3C7, "$\\chi$"},
                                       {0x3C8, "$\\psi$"},
                                       {0x3C9, "$\\omega$"},
                                       {0x2009, "\\,"},
                                       {0x2010, "-"},
                                       {0x2011, "-"},
                                       {0x2013, "--"},
                                       {0x2014, "---"},
                                       {0x2018, "`"},
                                       {0x2019, "'"},
                                       {0x201C, "``"},
                                       {0x201D, "''"},
                                       {0x2022, "$\\bullet$"},
                                       {0x2026, "\\ldots{}"},
                                       {0x202F, "\\,"},
                                       {0x2032, "$'$"},
                                       {0x20AC, "EUR"},
                                       {0x2190, "$\\leftarrow$"},
                                       {0x2192, "$\\rightarrow$"},
                                       {0x2208, "$\\in$"},
                                       {0x2212, "$-$"},
                                       {0x221A, "$\\surd$"},
                                       {0x221E, "$\\infty$"},
                                       {0x2248, "$\\approx$"},
                                       {0x2260, "$\\neq$"},
                                       {0x2264, "$\\leq$"},
                                       {0x2265, "$\\geq$"},
                                       {0x22C5, "$\\cdot$"}};

/// Letters that fontenc T1 has: Latin-1 and the usual ones of Latin Extended-A.
bool isLatinLetter(char32_t c)
{
    constexpr char32_t missing[] = {0x126, 0x127, 0x138, 0x13F, 0x140, 0x149, 0x166, 0x167};
    return c >= 0xC0 && c <= 0x17E && std::ranges::find(missing, c) == std::end(missing);
}

std::string numberOf(char32_t c)
{
    char buffer[16];
    std::snprintf(buffer, sizeof buffer, "U+%04X", static_cast<unsigned>(c));
    return buffer;
}

std::string texOf(char32_t c, std::string_view bytes)
{
    const auto* found = std::ranges::lower_bound(escapes, c, {}, &CharacterEscape::character);
    if (found != std::end(escapes) && found->character == c) return std::string(found->tex);
    if (c < 0x20 || c == 0x7F) return {};
    return c < 0x7F || isLatinLetter(c) ? std::string(bytes) : numberOf(c);
}

/// Calls use(character, bytes) for every character. A byte that begins none counts as a question mark.
template <class Use>
void eachCharacter(std::string_view text, const Use& use)
{
    while (!text.empty()) {
        const std::size_t length = protocols::utf8Length(text);
        use(length == 0 ? U'?' : protocols::utf8Character(text), length == 0 ? std::string_view("?") : text.substr(0, length));
        text.remove_prefix(std::max<std::size_t>(1, length));
    }
}

/// Points of a character of Computer Modern, 10 pt (cmr10.tfm), rounded up within its class.
double widthOf(char32_t c)
{
    constexpr std::u32string_view narrow = U" .,:;'!|il\u2019", slim = U"()[]-jtfrI`/", wide = U"mwMWOQ%@&",
                                  broad = U"\u2212\u00D7\u00B1<>=+\u2014";
    if (narrow.find(c) != std::u32string_view::npos) return 3.4;
    if (slim.find(c) != std::u32string_view::npos) return 4.0;
    if (wide.find(c) != std::u32string_view::npos) return 8.6;
    if (broad.find(c) != std::u32string_view::npos) return 7.9;
    if (c >= U'A' && c <= U'Z') return 7.4;
    return c < 0x180 || (c >= 0x2010 && c <= 0x2032) ? 5.3 : 6 * 6.0;  // The last is a number: "U+4E2D".
}

}  // namespace

std::string escapedTex(const std::string& text)
{
    std::string tex;
    eachCharacter(text, [&](char32_t c, std::string_view bytes) { tex += texOf(c, bytes); });
    return tex;
}

std::string breakableTex(const std::string& text)
{
    constexpr int longestUnbroken = 8;
    std::string tex;
    int unbroken = 0;
    eachCharacter(text, [&](char32_t c, std::string_view bytes) {
        unbroken = c == U' ' ? 0 : unbroken + 1;
        if (unbroken > longestUnbroken) {
            tex += "\\hspace{0pt}";
            unbroken = 1;
        }
        tex += texOf(c, bytes);
    });
    return tex;
}

double texWidth(const std::string& text)
{
    double width = 0;
    eachCharacter(text, [&](char32_t c, std::string_view) { width += widthOf(c); });
    return width;
}

}  // namespace reports
