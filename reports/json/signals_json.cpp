#include "reports/json/signals_json.h"

#include <nlohmann/json.hpp>

#include "protocols/files/errors.h"
#include "reports/json/json_fields.h"

namespace reports {
namespace {

/// The number of a field, or the reason why there is none.
stats::Value valueOf(const Json& object, const std::string& key)
{
    if (object.contains(key) && object[key].is_number()) return object[key].get<double>();
    const Json why = object.value("why", Json::object());
    return stats::Value::undefined(why.value(key, "not given"));
}

stats::Interval intervalOf(const Json& object, const std::string& key)
{
    if (object.contains(key) && object[key].is_array() && object[key].size() == 2)
        return {object[key][0].get<double>(), object[key][1].get<double>()};
    const stats::Value none = valueOf(object, key);
    return {none, none};
}

SignalEquivalence equivalenceOf(const Json& tost)
{
    SignalEquivalence equivalence;
    equivalence.bounds = intervalOf(tost, "bounds");
    equivalence.boundsAre = tost.value("bounds_are", "");
    equivalence.pLower = valueOf(tost, "p_lower");
    equivalence.pUpper = valueOf(tost, "p_upper");
    equivalence.p = valueOf(tost, "p");
    equivalence.ci90 = intervalOf(tost, "ci90");
    if (tost.contains("equivalent") && tost["equivalent"].is_boolean())
        equivalence.equivalent = tost["equivalent"].get<bool>();
    else
        equivalence.whyNoVerdict = valueOf(tost, "equivalent").why();
    equivalence.verdict = tost.value("verdict", "");
    return equivalence;
}

SignalTest testOf(const Json& row)
{
    return {row.value("signal", ""),
            row.value("unit", ""),
            row.value("n", std::size_t{0}),
            valueOf(row, "mean_difference"),
            valueOf(row, "statistic"),
            valueOf(row, "df"),
            valueOf(row, "p"),
            intervalOf(row, "ci95"),
            equivalenceOf(row.value("tost", Json::object()))};
}

Json equivalenceJson(const SignalEquivalence& equivalence)
{
    Json tost = Json::object();
    put(tost, "bounds", equivalence.bounds);
    tost["bounds_are"] = equivalence.boundsAre;
    // Bounds of width zero allow no test: its fields are left out as a whole.
    if (equivalence.equivalent || !equivalence.verdict.empty()) {
        put(tost, "p_lower", equivalence.pLower);
        put(tost, "p_upper", equivalence.pUpper);
        put(tost, "p", equivalence.p);
        put(tost, "ci90", equivalence.ci90);
    }
    if (equivalence.equivalent)
        tost["equivalent"] = *equivalence.equivalent;
    else
        putNull(tost, "equivalent", equivalence.whyNoVerdict);
    if (!equivalence.verdict.empty()) tost["verdict"] = equivalence.verdict;
    return tost;
}

Json testJson(const SignalTest& test)
{
    Json row{{"signal", test.signal}, {"unit", test.unit}, {"n", test.n}};
    put(row, "mean_difference", test.meanDifference);
    put(row, "statistic", test.statistic);
    put(row, "df", test.df);
    put(row, "p", test.p);
    put(row, "ci95", test.ci95);
    row["tost"] = equivalenceJson(test.equivalence);
    return row;
}

}  // namespace

std::optional<SignalComparison> signalsFromJson(const std::string& text)
{
    if (text.empty() || text == "{}") return std::nullopt;
    try {
        const Json json = Json::parse(text);
        SignalComparison signals{valueOf(json, "friction_mae"),
                                 valueOf(json, "friction_mae_over_mean"),
                                 valueOf(json, "height_ssim"),
                                 valueOf(json, "height_range_mm"),
                                 {}};
        for (const Json& row : json.value("t_tests", Json::array())) signals.tests.push_back(testOf(row));
        return signals;
    } catch (const Json::exception& fault) {
        throw protocols::workFailed({"the comparison of signals cannot be read (" + std::string(fault.what()) + ")",
                                     "the study's stored signals", "the object that `study new` wrote",
                                     "check the study with `vis2hap verify`"});
    }
}

nlohmann::ordered_json signalsJson(const SignalComparison& signals)
{
    Json json = Json::object();
    put(json, "friction_mae", signals.frictionMae);
    put(json, "friction_mae_over_mean", signals.frictionMaeOverMean);
    put(json, "height_ssim", signals.heightSsim);
    put(json, "height_range_mm", signals.heightRangeMm);
    json["t_tests"] = Json::array();
    for (const SignalTest& test : signals.tests) json["t_tests"].push_back(testJson(test));
    return json;
}

}  // namespace reports
