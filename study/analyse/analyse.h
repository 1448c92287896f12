// Answers requests for analyses of the stats module, as `vis2hap analyse` does for a file of them. A request is
// {"analysis": name, "inputs": {...}, "options": {...}}.
//
// An answer has one entry for each quantity. A quantity that does not exist is null, with its reason in "why". A number
// beyond the range of double is a decimal in quotes, and infinities are "inf" and "-inf".
#pragma once

#include <string>

#include "study/analyse/named_analysis.h"

namespace study::analyse {

/// All analyses.
const std::vector<NamedAnalysis>& analyses();

/// All analyses with their inputs and options, as text for a terminal.
std::string listOfAnalyses();

/// {"error": text} for a request with a fault, and for one whose analysis fails in any other way;
/// {"status": "degenerate", "reason": text} where the analysis is not defined for these data. A field that is not in brackets
/// must be there. An unknown option is a fault. An unknown input is one while a known input is absent; else it is a remark. A
/// recipe may bring any constants.
nlohmann::ordered_json answerOf(const nlohmann::json& request, const std::filesystem::path& folder);

}  // namespace study::analyse
