// One analysis that `vis2hap analyse` knows by name, and the request that it answers.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string_view>
#include <vector>

namespace study::analyse {

struct AnalysisRequest {
    const nlohmann::json& inputs;
    const nlohmann::json& options;
    const std::filesystem::path& folder;  ///< names of array files are relative to it
};

struct NamedAnalysis {
    std::string_view name;
    nlohmann::ordered_json (*answer)(const AnalysisRequest&);  ///< throws RequestFault
};

}  // namespace study::analyse
