// The words of claims: verdicts and generalisations as readers see them.
#pragma once

#include <string>

#include "stats/claims/claims.h"

namespace reports {

/// "different", "equivalent", "different, within the bounds" or "not decided".
std::string wordsOf(stats::Verdict verdict);

/// The verdict of an equivalence test (stats/tests/equivalence.h) in a table: "difference not shown / equivalent". A large p does
/// not show that there is no difference. JSON keeps the words of stats, which peers reproduce.
std::string tableWords(const std::string& verdict);

/// "these fabrics" or "fabrics like these".
std::string wordsOf(stats::Generalisation generalisation);

}  // namespace reports
