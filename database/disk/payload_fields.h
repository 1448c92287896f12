// Fields of the payloads of the log, which somebody may have altered. A field that is missing or of another kind, or a
// number that no int holds, has a default.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

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
    if (value == payload.end() || !value->is_number_integer()) return otherwise;
    const bool isInt = value->is_number_unsigned() ? std::in_range<int>(value->get<std::uint64_t>())
                                                   : std::in_range<int>(value->get<std::int64_t>());
    return isInt ? value->get<int>() : otherwise;
}

}  // namespace database
