// Statistics in JSON. An undefined number is null, with its reason in the object's "why".
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "stats/kernels/value.h"

namespace study::analyse {

void put(nlohmann::ordered_json& object, const std::string& field, const stats::Value& value);

/// Null where one of its ends does not exist.
void put(nlohmann::ordered_json& object, const std::string& field, const stats::Interval& interval);

}  // namespace study::analyse
