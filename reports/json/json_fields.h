// Numbers of the statistics as fields of JSON. What does not exist is null, with its reason in the object's "why".
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "stats/kernels/value.h"

namespace reports {

using Json = nlohmann::ordered_json;

/// Why nothing says whether people answered, where the answers come from a table.
inline constexpr const char* kindsUnknown = "the table does not tell who answered: an export has a column kind";

/// object[key] = null, object["why"][key] = why.
void putNull(Json& object, const std::string& key, const std::string& why);

/// Each key is null, with the same reason.
void putLeftOut(Json& object, const std::vector<std::string>& keys, const std::string& why);

/// Moves "why", where there is one, behind all other keys.
void putReasonsLast(Json& object);

/// A number that is not finite is null too.
void put(Json& object, const std::string& key, const stats::Value& value);

/// [low, high], or null.
void put(Json& object, const std::string& key, const stats::Interval& interval);

/// Degrees of freedom and the like: a whole number is written without ".0".
void putWhole(Json& object, const std::string& key, const stats::Value& value);

/// A p value. One that is too small for a double is null, with its power of ten as the reason.
void putP(Json& object, const std::string& key, const stats::Value& p, const stats::Value& logP);

/// The same for a p value without a logarithm, such as a corrected one.
void putP(Json& object, const std::string& key, const stats::Value& p);

}  // namespace reports
