// Text in UTF-8, character by character (RFC 3629: no overlong forms, no surrogates, at most U+10FFFF).
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace protocols {

/// Number of bytes of the well-formed character at the front of `text`, or 0.
std::size_t utf8Length(std::string_view text);

/// The character at the front of `text`, which begins with a well-formed one.
char32_t utf8Character(std::string_view text);

/// Offset of the first byte that begins no well-formed character.
std::optional<std::size_t> firstByteThatIsNotUtf8(std::string_view text);

/// The text of a file without the mark that some editors write at its beginning.
std::string_view withoutByteOrderMark(std::string_view text);

/// Whether a database keeps the text as it is: false with NUL, which ends texts, and with U+FEFF, U+FFFE or U+FFFF, which Qt
/// and SQLite drop or replace.
bool isKeptText(std::string_view text);

/// The text, or of a longer one whole characters of at most `mostBytes` bytes and "...": for messages.
std::string inShort(std::string_view text, std::size_t mostBytes);

}  // namespace protocols
