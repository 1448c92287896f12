#include "reports/json/json_fields.h"

#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>

#include "reports/text/number_text.h"

namespace reports {

void putNull(Json& object, const std::string& key, const std::string& why)
{
    object[key] = nullptr;
    object["why"][key] = why;
}

void putLeftOut(Json& object, const std::vector<std::string>& keys, const std::string& why)
{
    for (const std::string& key : keys) putNull(object, key, why);
}

void putReasonsLast(Json& object)
{
    if (!object.contains("why")) return;
    Json why = object["why"];
    object.erase("why");
    object["why"] = std::move(why);
}

void put(Json& object, const std::string& key, const stats::Value& value)
{
    if (!value.exists())
        putNull(object, key, value.why());
    else if (!std::isfinite(*value))
        putNull(object, key, "unbounded");
    else
        object[key] = *value;
}

void put(Json& object, const std::string& key, const stats::Interval& interval)
{
    if (!interval.low.exists() || !interval.high.exists())
        putNull(object, key, interval.low.exists() ? interval.high.why() : interval.low.why());
    else
        object[key] = {*interval.low, *interval.high};
}

void putWhole(Json& object, const std::string& key, const stats::Value& value)
{
    if (value.exists() && std::fabs(*value) < 1e15 && std::nearbyint(*value) == *value)
        object[key] = static_cast<std::int64_t>(*value);
    else
        put(object, key, value);
}

void putP(Json& object, const std::string& key, const stats::Value& p, const stats::Value& logP)
{
    put(object, key, writableP(p, logP));
}

void putP(Json& object, const std::string& key, const stats::Value& p) { put(object, key, writableP(p)); }

}  // namespace reports
