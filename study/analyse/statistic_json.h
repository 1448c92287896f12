// Statistics in JSON. An undefined number is null, with its reason in the object's "why".
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "stats/kernels/value.h"

namespace study::analyse {

inline void put(nlohmann::ordered_json& object, const std::string& field, const stats::Value& value)
{
    if (value.exists()) {
        object[field] = *value;
        return;
    }
    object[field] = nullptr;
    object["why"][field] = value.why();
}

inline void put(nlohmann::ordered_json& object, const std::string& field, const stats::Interval& interval)
{
    if (interval.low.exists() && interval.high.exists()) {
        object[field] = {*interval.low, *interval.high};
        return;
    }
    object[field] = nullptr;
    object["why"][field] = interval.low.exists() ? interval.high.why() : interval.low.why();
}

}  // namespace study::analyse
