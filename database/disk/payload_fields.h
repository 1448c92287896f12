// Fields of the payloads of the log, which somebody may have altered. A field that is missing or of another kind has a default.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "protocols/files/strict_json.h"

namespace database {

/// An empty object for text that is no JSON object.
inline nlohmann::json payloadIn(const std::string& text)
{
    nlohmann::json payload = protocols::storedJson(text);
    return payload.is_object() ? payload : nlohmann::json::object();
}

inline std::string textIn(const nlohmann::json& payload, const char* field)
{
    const auto value = payload.find(field);
    return value != payload.end() && value->is_string() ? value->get<std::string>() : std::string();
}

inline bool yesIn(const nlohmann::json& payload, const char* field)
{
    const auto value = payload.find(field);
    return value != payload.end() && value->is_boolean() && value->get<bool>();
}

inline int numberIn(const nlohmann::json& payload, const char* field, int otherwise)
{
    const auto value = payload.find(field);
    return value != payload.end() && value->is_number_integer() ? value->get<int>() : otherwise;
}

}  // namespace database
