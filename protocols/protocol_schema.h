// The check of a protocol file against its JSON Schema, protocol.schema.json.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "protocols/texts/protocol_edition.h"

namespace protocols {

struct SchemaFault {
    std::string place;  ///< "phases[0].scale.max"; of a missing or unknown key its own place; empty: the whole document
    std::string text;   ///< the place, the value there, and what was expected
};

/// Most elements of a list, and most keys of an object, anywhere in a protocol; the schema allows fewer in some places.
inline constexpr std::size_t mostElements = 2'000;

/// Most values of a protocol in all, those inside each other included. Shipped ones have at most 200.
inline constexpr std::size_t mostValues = 20'000;

/// Most faults that are listed.
inline constexpr std::size_t mostFaults = 100;

struct SchemaFaults {
    std::vector<SchemaFault> listed;  ///< at most `mostFaults`
    std::size_t unlisted = 0;         ///< further ones: then any value may have a fault that is not known
    bool isTooLarge = false;          ///< only its size was checked
};

/// The places at which the document breaks the schema. An earlier edition has no limits for question ids.
SchemaFaults schemaFaultsOf(const nlohmann::json& document, ProtocolEdition edition);

}  // namespace protocols
