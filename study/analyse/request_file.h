// A file of requests for analyses, as `vis2hap analyse` reads it: {"cases": [{"id": ..., "analysis": ..., ...}]}.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace study::analyse {

/// The answer of each case by its id, in the order of the cases. `where` names the file in errors; CSV files that the requests
/// name lie in `folder`. Throws badInput for text that is no such file, and where two cases have one id.
nlohmann::ordered_json answersTo(std::string_view text, const std::string& where, const std::filesystem::path& folder);

}  // namespace study::analyse
