// The part of a protocol's check that its JSON Schema (protocol.schema.json) says.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace protocols {

/// Every place where the document breaks the schema, each "place: what it has, what was expected".
std::vector<std::string> schemaFaultsOf(const nlohmann::json& document);

}  // namespace protocols
