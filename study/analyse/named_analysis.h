// One analysis that `vis2hap analyse` knows by name, and the request that it answers.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string_view>
#include <vector>

namespace study::analyse {

struct AnalysisRequest {
    const nlohmann::json& inputs;
    const nlohmann::json& options;
    const std::filesystem::path& folder;  ///< names of array files are relative to it
};

/// The names of fields stand behind one another, with blanks between them. A field in brackets may be absent.
struct NamedAnalysis {
    std::string_view name;
    nlohmann::ordered_json (*answer)(const AnalysisRequest&);  ///< throws RequestFault
    std::string_view inputs;                                   ///< "kind x [y]"
    std::string_view options;                                  ///< "p0 [conf_level]"
    std::string_view purpose;                                  ///< a few words for `vis2hap analyse --list`
};

}  // namespace study::analyse
