// Counts and lists as English words.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace reports {

/// "participant" for one, "participants" for any other number.
std::string pluralOf(std::size_t n, const std::string& singular);

/// "1 participant", "2 participants".
std::string counted(std::size_t n, const std::string& singular);

/// "a, b and c".
std::string listed(const std::vector<std::string>& items);

/// "Q1" becomes "q1", as in the names of files and of statistics. ASCII letters only.
std::string lowerCase(std::string text);

}  // namespace reports
