// The data sheet as plain text, to read and to hand in.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace study::records {

/// `sheet`: as dataSheetOf() gives it. Lines have at most 100 characters, except long words such as hashes and paths.
std::string textOfDataSheet(const nlohmann::ordered_json& sheet);

}  // namespace study::records
