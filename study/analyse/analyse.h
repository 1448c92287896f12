// The analyses of the stats module by name, one request answered at a time: what `vis2hap analyse` runs
// over a file of them. A request is {"analysis": name, "inputs": {...}, "options": {...}}.
//
// Answers hold one entry a quantity. A quantity that does not exist is null, with its reason in "why"; one
// beyond the range of double is a decimal in quotes, and so are "inf" and "-inf".
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace study::analyse {

struct AnalysisRequest {
    const nlohmann::json& inputs;
    const nlohmann::json& options;
    const std::filesystem::path& folder;  ///< that the names of arrays are relative to
};

struct Analysis {
    std::string_view name;
    nlohmann::ordered_json (*answer)(const AnalysisRequest&);  ///< throws RequestFault
};

// One file a group: analyse_means.cpp, ...
std::vector<Analysis> analysesOfMeans();
std::vector<Analysis> analysesOfCounts();
std::vector<Analysis> analysesOfTables();
std::vector<Analysis> analysesOfSignals();
std::vector<Analysis> analysesOfSamples();

/// Every analysis there is.
const std::vector<Analysis>& analyses();

/// {"error": text} where the request cannot be understood, {"status": "degenerate", "reason": text} where
/// the analysis is not defined for these data.
nlohmann::ordered_json answerOf(const nlohmann::json& request, const std::filesystem::path& folder);

}  // namespace study::analyse
