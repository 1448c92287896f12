// The check of a protocol file against its JSON Schema, protocol.schema.json.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "protocols/protocol_edition.h"

namespace protocols {

struct SchemaFault {
    std::string place;  ///< "phases[0].scale.max"; of a missing or unknown key its own place; empty: the whole document
    std::string text;   ///< the place, the value there, and what was expected
};

/// Every place at which the document breaks the schema. An earlier edition has no limits for question ids.
std::vector<SchemaFault> schemaFaultsOf(const nlohmann::json& document, ProtocolEdition edition);

}  // namespace protocols
