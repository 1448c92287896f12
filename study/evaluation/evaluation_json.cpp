#include "study/evaluation/evaluation_json.h"

#include <nlohmann/json.hpp>

#include "study/evaluation/criteria.h"

namespace study::evaluation {

namespace {

using Json = nlohmann::ordered_json;

/// Writes the value, or null and its reason if it does not exist.
void put(Json& object, std::string_view field, const stats::Value& value)
{
    const std::string name(field);
    object[name] = value.exists() ? Json(*value) : Json(nullptr);
    if (!value.exists()) object["why"][name] = value.why();
}

Json countsJson(const std::map<Modality, int>& counts)
{
    Json json = Json::object();
    for (const Modality modality : {Modality::Visual, Modality::Tactile, Modality::Friction})
        json[rendering::fabrics::nameOf(modality)] = counts.contains(modality) ? counts.at(modality) : 0;
    return json;
}

Json leaksJson(const Leaks& leaks)
{
    return {{"testing_part", countsJson(leaks.tested)},
            {"left_out_trained_on", countsJson(leaks.trainedOn)},
            {"left_out_place_trained_on", countsJson(leaks.placeTrainedOn)},
            {"duplicates", countsJson(leaks.duplicates)},
            {"overlaps", countsJson(leaks.overlaps)},
            {"places_known", leaks.placesKnown}};
}

void putValues(Json& json, const Values& values)
{
    for (const MeasureRow& row : measureTable()) put(json, row.field, at(values, row.measure));
}

/// Two numbers for each measure, or null and a reason.
Json intervalsJson(const Intervals& intervals)
{
    Json json = Json::object();
    for (const MeasureRow& row : measureTable()) {
        const stats::Interval& interval = at(intervals, row.measure);
        const std::string field(row.field);
        const bool exists = interval.low.exists() && interval.high.exists();
        json[field] = exists ? Json{*interval.low, *interval.high} : Json(nullptr);
        if (!exists) json["why"][field] = interval.low.exists() ? interval.high.why() : interval.low.why();
    }
    return json;
}

Json meansJson(const std::string& measure, const MeanComparison& means)
{
    const stats::EquivalenceTest& test = means.equivalence;
    Json json{{"measure", measure}, {"unit", "fabric"}, {"n", test.n}, {"bounds", {-means.bound, means.bound}}};
    put(json, "mean_difference", test.estimate);
    put(json, "p_lower", test.pLower);
    put(json, "p_upper", test.pUpper);
    put(json, "p", test.p);
    json["equivalent"] = test.equivalent;
    json["verdict"] = test.verdict();
    put(json, "t", test.tDifference);
    put(json, "p_t_test", test.pDifference);
    return json;
}

Json predictorJson(const PredictorResult& predictor)
{
    Json json{{"id", predictor.predictor.id}, {"name", predictor.predictor.name}};
    putValues(json, predictor.mean);
    json["ci95"] = intervalsJson(predictor.ci95);
    if (predictor.predictor.kind != PredictorKind::Measured)
        json["equal_means"] = {meansJson("mean_friction", predictor.friction), meansJson("sq_mm", predictor.sq)};
    json["fabrics"] = Json::array();
    for (const FabricValues& fabric : predictor.fabrics) {
        Json one{{"fabric", fabric.fabric.value}, {"pairs", fabric.pairs}};
        putValues(one, fabric.values);
        json["fabrics"].push_back(one);
    }
    return json;
}

Json modelJson(const ModelUsed& model)
{
    return {{"name", model.name},
            {"sha256", model.sha256},
            {"losses", model.losses},
            {"held_out", model.heldOut},
            {"steps", model.steps}};
}

Json againstJson(const ModelUsed& model)
{
    Json json = modelJson(model);
    json["fair_control"] = model.differences.empty();
    json["training_differs"] = model.differences;
    return json;
}

Json criteriaJson(const Evaluation& evaluation)
{
    Json json = Json::array();
    for (const Criterion& one : criteriaOf(evaluation)) {
        json.push_back({{"what", one.what}, {"asked", one.required}, {"found", one.found}});
        json.back()["reached"] = one.reached ? Json(*one.reached) : Json(nullptr);
        if (!one.reached) json.back()["why"]["reached"] = one.found;
    }
    return json;
}

}  // namespace

nlohmann::ordered_json evaluationJson(const Evaluation& evaluation)
{
    Json json{{"schema", "vis2hap.evaluation/1"},
              {"dataset", evaluation.dataset},
              {"pairing", evaluation.aligned ? "aligned" : "weak"},
              {"model", modelJson(evaluation.models.front())},
              {"against", Json::array()},
              {"split", {{"by", std::string(nameOf(evaluation.split))}, {"seed", evaluation.splitSeed}}},
              {"averaged", "within a fabric, then over fabrics; ratios geometrically"},
              {"pairs", evaluation.pairs},
              {"fabrics", evaluation.fabrics},
              {"controls_know",
               {{"photographs", evaluation.trainingPhotographs},
                {"presses", evaluation.trainingPresses},
                {"strokes", evaluation.trainingStrokes}}},
              {"leaks", leaksJson(evaluation.leaks)},
              {"bounds_fraction", evaluation.boundsFraction},
              {"notes", evaluation.notes}};
    for (std::size_t i = 1; i < evaluation.models.size(); ++i) json["against"].push_back(againstJson(evaluation.models[i]));
    put(json, "ssim_range_mm", evaluation.rangeMm);
    put(json, "friction_noise_floor", evaluation.noiseFloor);
    json["speakers"] = Json::array();
    for (const PredictorResult& predictor : evaluation.predictors) json["speakers"].push_back(predictorJson(predictor));
    json["criteria"] = criteriaJson(evaluation);
    return json;
}

}  // namespace study::evaluation
