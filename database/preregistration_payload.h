// What the log keeps of a registered plan: the payload of its entry "preregistered".
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "database/preregistrations.h"

namespace database {

nlohmann::ordered_json payloadOf(const PreregistrationRecord& record);

/// Whether the payload has all fields with their types.
bool isPreregistration(const nlohmann::json& payload);

/// What is wrong with a payload that should have this number; empty where nothing is.
std::string faultOfPreregistration(const nlohmann::json& payload, int number);

}  // namespace database
