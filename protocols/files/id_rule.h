// The one rule for ids that come from outside: of participants, fabrics, and whatever else a lab names. Conditions keep their
// table, and question ids are narrower, because they name columns (question_ids.h). Stored ids are read without this rule.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace protocols {

/// Most bytes of an id in UTF-8: 64 Latin letters, or 21 Japanese ones. As part of a file name it becomes three times as long.
inline constexpr std::size_t longestId = 64;

/// The rule in words, for messages: "1 to 64 bytes of UTF-8 without ...".
std::string idRule();

/// What the id breaks in the rule, such as "begins with a dot"; empty for a good id. Letters, digits and signs of every script
/// are good, and so are blanks between them. Refused are: an empty or too long id; bytes that are not UTF-8; control characters;
/// invisible characters that separate words or change the direction of the text; "/", "\" and ","; a dot or dash at the
/// beginning; a blank at either end. So an id is never a path, an option, a part of a list, or another id in disguise.
std::string faultOfId(std::string_view id);

/// Throws badInput for an id that breaks the rule. `named` is what it names ("a participant"), `where` the place it came from.
void requireGoodId(std::string_view id, const std::string& named, const std::string& where);

/// As faultOfId(), for an id that nothing has yet. Refused are, too: NA, NaN, null and None in any case, which programs of
/// statistics read as missing values.
std::string faultOfNewId(std::string_view id);

/// As requireGoodId(), by faultOfNewId().
void requireGoodNewId(std::string_view id, const std::string& named, const std::string& where);

/// Most bytes of a person's name, and of a reason, in UTF-8.
inline constexpr std::size_t longestName = 200, longestReason = 1000;

/// The rule for one line of free words, such as an operator's name, in words for messages.
std::string lineRule(std::size_t mostBytes);

/// What the line breaks in the rule; empty for a good one. Every script and every sign is good. Refused are: nothing but blanks;
/// more than `mostBytes`; bytes that are not UTF-8; control characters, and so line ends; invisible characters.
std::string faultOfLine(std::string_view line, std::size_t mostBytes);

/// What a text of several lines, such as a question, breaks; empty for a good one. Line ends and tabs are good. Refused are:
/// other control characters, and what no database keeps (isKeptText()).
std::string faultOfWords(std::string_view words);

}  // namespace protocols
