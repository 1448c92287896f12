// The check of a protocol file against its JSON Schema, protocol.schema.json.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace protocols {

/// Whether the schema's rules for question ids apply.
enum class RuleOfIds {
    Checked,
    AsKept,  ///< by a study that was made before there were such rules
};

struct SchemaFault {
    std::string place;  ///< "phases[0].scale.max"; of a missing or unknown key its own place; empty: the whole document
    std::string text;   ///< the place, the value there, and what was expected
};

/// Every place at which the document breaks the schema.
std::vector<SchemaFault> schemaFaultsOf(const nlohmann::json& document, RuleOfIds rule);

}  // namespace protocols
