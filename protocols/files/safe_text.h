// Text from outside made harmless: for a terminal, and as the name of a file.
#pragma once

#include <string>
#include <string_view>

namespace protocols {

/// Control characters (also those of C1, as UTF-8) and marks that change the direction of the text written as "\x1b"; a terminal
/// would obey them. Line ends become blanks.
std::string printable(std::string_view text);

/// The same for a text of several lines: its line ends stay.
std::string printableLines(std::string_view text);

/// The text without the marks that change its direction (U+202A to U+202E, U+2066 to U+2069). Copied numbers and names often
/// stand between two of them.
std::string withoutTurns(std::string_view text);

/// One word of a command line, as a shell needs it: a text of letters, digits and a few signs stays, any other stands in single
/// quotes. Control characters are written as printable() does.
std::string shellWord(std::string_view text);

/// A name without any path: letters, digits, "-", "_" and "." stay, every other byte becomes "%" with two hexadecimal digits, and
/// so does a dot at the beginning. Different texts have different names.
std::string fileNameOf(std::string_view id);

}  // namespace protocols
