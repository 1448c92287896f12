#include "reports/json/signals_json.h"

#include <nlohmann/json.hpp>

#include "protocols/files/errors.h"
#include "protocols/files/strict_json.h"
#include "protocols/json_count.h"
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

SignalValues measuresOf(const Json& object)
{
    SignalValues values;
    for (const SignalMeasureRow& row : signalMeasureRows) values[row.measure] = valueOf(object, row.field);
    return values;
}

SignalDifference differenceOf(const Json& object)
{
    return {protocols::wholeIn(object, "n", std::size_t{0}), valueOf(object, "mean_difference"), intervalOf(object, "ci95"),
            valueOf(object, "p"), valueOf(object, "p_holm")};
}

SignalSource sourceOf(const std::string& id, const Json& object)
{
    SignalSource source{id, object.value("name", id), {}, object.value("not_a_fair_control", ""), measuresOf(object), {}, {}};
    if (object.contains("steps")) source.steps = protocols::wholeOf<int>(object["steps"]);
    const Json differences = object.value("difference", Json::object());
    for (const SignalMeasureRow& row : signalMeasureRows)
        if (differences.contains(row.field)) source.differences[row.measure] = differenceOf(differences[row.field]);
    for (const Json& fabric : object.value("fabrics", Json::array()))
        source.fabrics.push_back({fabric.value("fabric", ""), measuresOf(fabric)});
    return source;
}

SignalControls controlsOf(const Json& json)
{
    const Json known = json.value("controls_know", Json::object());
    SignalControls controls{json.value("pairing", ""),
                            known.value("photographs", std::size_t{0}),
                            known.value("presses", std::size_t{0}),
                            known.value("strokes", std::size_t{0}),
                            json.value("notes", std::vector<std::string>{}),
                            sourceOf("generated", json.value("generated", Json::object())),
                            sourceOf("generated_mean", json.value("generated_mean", Json::object())),
                            {}};
    for (const auto& [id, source] : json["controls"].items()) controls.controls.push_back(sourceOf(id, source));
    return controls;
}

/// Measures of the generated signals that stand beside the fields of earlier versions.
constexpr SignalMeasure addedMeasures[] = {SignalMeasure::HeightSsimRegistered, SignalMeasure::HeightSpectrum,
                                           SignalMeasure::HeightSqRatio, SignalMeasure::MeanFrictionError,
                                           SignalMeasure::FrictionSpectrum};

void putMeasures(Json& object, const SignalValues& values)
{
    for (const SignalMeasureRow& row : signalMeasureRows) put(object, row.field, values[row.measure]);
}

Json differenceJson(const SignalDifference& difference)
{
    Json object{{"n", difference.n}};
    put(object, "mean_difference", difference.meanDifference);
    put(object, "ci95", difference.ci95);
    put(object, "p", difference.p);
    put(object, "p_holm", difference.pHolm);
    return object;
}

Json sourceJson(const SignalSource& source)
{
    Json object{{"name", source.name}};
    if (source.steps) object["steps"] = *source.steps;
    if (!source.whyUnfair.empty()) object["not_a_fair_control"] = source.whyUnfair;
    putMeasures(object, source.mean);
    for (const auto& [measure, difference] : source.differences)
        object["difference"][rowOf(measure).field] = differenceJson(difference);
    object["fabrics"] = Json::array();
    for (const FabricSignalValues& fabric : source.fabrics) {
        Json one{{"fabric", fabric.fabric}};
        putMeasures(one, fabric.values);
        object["fabrics"].push_back(one);
    }
    return object;
}

void putControls(Json& json, const SignalComparison& signals)
{
    if (!signals.controls) {
        for (const SignalMeasure measure : addedMeasures) putNull(json, rowOf(measure).field, signals.whyNoControls);
        putNull(json, "controls", signals.whyNoControls);
        return;
    }
    const SignalControls& controls = *signals.controls;
    for (const SignalMeasure measure : addedMeasures) put(json, rowOf(measure).field, controls.generated.mean[measure]);
    json["pairing"] = controls.pairing;
    json["controls_know"] = {{"photographs", controls.photographs}, {"presses", controls.presses}, {"strokes", controls.strokes}};
    json["notes"] = controls.notes;
    json["controls"] = Json::object();
    json["generated"] = sourceJson(controls.generated);
    json["generated_mean"] = sourceJson(controls.generatedMean);
    for (const SignalSource& source : controls.controls) json["controls"][source.id] = sourceJson(source);
}

}  // namespace

std::optional<SignalComparison> signalsFromJson(const std::string& text)
{
    if (text.empty() || text == "{}") return std::nullopt;
    try {
        const Json json = protocols::storedOrderedJson(text);
        SignalComparison signals{valueOf(json, "friction_mae"),
                                 valueOf(json, "friction_mae_over_mean"),
                                 valueOf(json, "height_ssim"),
                                 valueOf(json, "height_range_mm"),
                                 {},
                                 {},
                                 {}};
        for (const Json& row : json.value("t_tests", Json::array())) signals.tests.push_back(testOf(row));
        if (json.contains("controls") && json["controls"].is_object())
            signals.controls = controlsOf(json);
        else if (json.contains("controls"))
            signals.whyNoControls = valueOf(json, "controls").why();
        else
            signals.whyNoControls = "the study was made by an earlier version, which stored no controls";
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
    putControls(json, signals);
    return json;
}

}  // namespace reports
