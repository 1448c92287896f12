// The words of claims: verdicts and generalisations as readers see them.
#pragma once

#include <string>

#include "stats/claims/claims.h"

namespace reports {

/// "different", "equivalent", "different, within the bounds" or "not decided".
std::string wordsOf(stats::Verdict verdict);

/// "these fabrics" or "fabrics like these".
std::string wordsOf(stats::Generalisation generalisation);

}  // namespace reports
