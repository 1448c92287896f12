#include "study/analyse/statistic_json.h"

#include <nlohmann/json.hpp>

namespace study::analyse {

void put(nlohmann::ordered_json& object, const std::string& field, const stats::Value& value)
{
    if (value.exists()) {
        object[field] = *value;
        return;
    }
    object[field] = nullptr;
    object["why"][field] = value.why();
}

void put(nlohmann::ordered_json& object, const std::string& field, const stats::Interval& interval)
{
    if (interval.low.exists() && interval.high.exists()) {
        object[field] = {*interval.low, *interval.high};
        return;
    }
    object[field] = nullptr;
    object["why"][field] = interval.low.exists() ? interval.high.why() : interval.low.why();
}

}  // namespace study::analyse
