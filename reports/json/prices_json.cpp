#include "reports/json/prices_json.h"

#include <nlohmann/json.hpp>

#include "protocols/files/errors.h"
#include "protocols/json_count.h"
#include "reports/json/json_fields.h"

namespace reports {
namespace {

std::string intervalField(const PriceMeasureRow& row) { return std::string(row.field) + "_ci95"; }

stats::Value storedNumber(const Json& object, const std::string& field)
{
    if (object.contains(field) && object.at(field).is_number()) return object.at(field).get<double>();
    return stats::Value::undefined(object.value("why", Json::object()).value(field, "not given"));
}

PriceFact storedFact(const Json& object, const PriceMeasureRow& row)
{
    PriceFact fact{storedNumber(object, row.field), {}};
    const std::string field = intervalField(row);
    if (object.contains(field) && object.at(field).is_array())
        fact.ci95 = {object.at(field).at(0).get<double>(), object.at(field).at(1).get<double>()};
    else
        fact.ci95 = {storedNumber(object, field), storedNumber(object, field)};
    return fact;
}

RenderingPrice storedPrice(const Json& object)
{
    RenderingPrice price{object.at("condition").get<std::string>(),
                         object.at("row").get<std::string>(),
                         object.at("quality").get<std::string>(),
                         object.value("settings", Json::object()).dump(),
                         object.at("usual_quality").get<bool>(),
                         protocols::wholeOf<std::size_t>(object.at("fabrics")),
                         {}};
    for (const PriceMeasureRow& row : priceMeasureRows) price[row.measure] = storedFact(object, row);
    return price;
}

}  // namespace

nlohmann::ordered_json priceJson(const RenderingPrice& price)
{
    Json json{{"condition", price.condition},
              {"row", price.row},
              {"quality", price.quality},
              {"usual_quality", price.usualQuality},
              {"settings", Json::parse(price.settings, nullptr, false)},
              {"fabrics", price.fabrics}};
    if (!json["settings"].is_object()) json["settings"] = Json::object();
    for (const PriceMeasureRow& row : priceMeasureRows) {
        put(json, row.field, price[row.measure].value);
        put(json, intervalField(row), price[row.measure].ci95);
    }
    putReasonsLast(json);
    return json;
}

std::vector<RenderingPrice> pricesFromJson(const nlohmann::ordered_json& prices)
{
    std::vector<RenderingPrice> stored;
    try {
        for (const Json& one : prices) stored.push_back(storedPrice(one));
    } catch (const Json::exception& fault) {
        throw protocols::workFailed({"the prices of the renderings cannot be read (" + std::string(fault.what()) + ")",
                                     "the study's stored signals", "the rows that `study new` wrote",
                                     "check the study with `vis2hap verify`"});
    }
    return stored;
}

}  // namespace reports
