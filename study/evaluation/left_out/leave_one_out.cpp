#include "study/evaluation/left_out/leave_one_out.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "protocols/files/errors.h"
#include "study/evaluation/evaluation_text.h"
#include "study/evaluation/summary.h"

namespace study::evaluation {

namespace {

using Json = nlohmann::ordered_json;

/// Columns of the text; the JSON has all measures.
constexpr std::array shownMeasures{Measure::FrictionMaeOverMean, Measure::MeanFrictionError, Measure::FrictionSpectrum,
                                   Measure::SsimRegistered,      Measure::HeightSpectrum,    Measure::SqRatio};

Json valuesJson(const Values& values)
{
    Json json = Json::object();
    for (const MeasureRow& row : measureTable()) {
        const stats::Value& value = at(values, row.measure);
        const std::string name(row.field);
        json[name] = value.exists() ? Json(*value) : Json();
        if (!value.exists()) json["why"][name] = value.why();
    }
    return json;
}

Values valuesFrom(const Json& json)
{
    Values values;
    for (const MeasureRow& row : measureTable()) {
        const std::string name(row.field);
        const Json& value = json.at(name);
        at(values, row.measure) = value.is_null() ? stats::Value::undefined(json.at("why").at(name).get<std::string>())
                                                  : stats::Value(value.get<double>());
    }
    return values;
}

/// A whole number from 0 to a thousand million; fails for any other.
int countIn(const Json& json, const char* key)
{
    constexpr std::uint64_t most = 1000000000;
    const std::uint64_t number = json.at(key).get_ref<const Json::number_unsigned_t&>();
    if (number > most) throw Json::other_error::create(501, "impossible count", nullptr);
    return static_cast<int>(number);
}

/// Means over the fabrics of predictor `place`.
Values meansOf(const LeaveOneOut& result, std::size_t place)
{
    Values means;
    for (const MeasureRow& row : measureTable()) {
        std::vector<stats::Value> values;
        for (const LeftOutFabric& fabric : result.fabrics) values.push_back(at(fabric.predictors[place].values, row.measure));
        at(means, row.measure) = averageOf(row.measure, values);
    }
    return means;
}

std::vector<std::string> cellsOf(const std::string& name, const std::string& pairs, const Values& values)
{
    std::vector<std::string> cells{name, pairs};
    for (const Measure measure : shownMeasures) cells.push_back(formatted(at(values, measure), rowOf(measure).format));
    return cells;
}

std::string leftOutLines(const std::vector<std::vector<std::string>>& rows)
{
    std::vector<std::size_t> widths(rows.front().size());
    for (const auto& row : rows)
        for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
    std::string text;
    for (const auto& row : rows) {
        for (std::size_t i = 0; i < row.size(); ++i) {
            const std::string gap(widths[i] - row[i].size(), ' ');
            text += i == 0 ? "  " + row[i] + gap : "  " + gap + row[i];
        }
        text += "\n";
    }
    return text;
}

}  // namespace

LeftOutFabric leftOutFabric(const Evaluation& evaluation)
{
    const ModelUsed& model = evaluation.models.front();
    LeftOutFabric left{{}, model.sha256, model.steps, evaluation.pairs, {}};
    for (const PredictorResult& one : evaluation.predictors) {
        if (one.predictor.kind == PredictorKind::Measured || one.fabrics.empty()) continue;
        left.fabric = one.fabrics.front().fabric;
        left.predictors.push_back({one.predictor.id, one.predictor.name, one.fabrics.front().values});
    }
    return left;
}

Json leftOutJson(const LeftOutFabric& fabric)
{
    Json json{{"fabric", fabric.fabric.value},
              {"model_sha256", fabric.modelSha256},
              {"steps", fabric.steps},
              {"pairs", fabric.pairs},
              {"predictors", Json::array()}};
    for (const LeftOutValues& one : fabric.predictors)
        json["predictors"].push_back({{"id", one.id}, {"name", one.name}, {"values", valuesJson(one.values)}});
    return json;
}

LeftOutFabric leftOutFrom(const Json& json, const std::string& where)
{
    try {
        LeftOutFabric fabric{protocols::FabricId(json.at("fabric").get<std::string>()),
                             json.at("model_sha256").get<std::string>(),
                             countIn(json, "steps"),
                             countIn(json, "pairs"),
                             {}};
        for (const Json& one : json.at("predictors"))
            fabric.predictors.push_back(
                {one.at("id").get<std::string>(), one.at("name").get<std::string>(), valuesFrom(one.at("values"))});
        return fabric;
    } catch (const Json::exception&) {
        throw protocols::badInput({"the values of a fabric that was left out are damaged", where,
                                   "values as `vis2hap train --leave-one-out` writes them", "run this shard again"});
    }
}

std::string leaveOneOutText(const LeaveOneOut& result)
{
    if (result.fabrics.empty() || result.fabrics.front().predictors.empty()) return "no fabric was tested\n";
    std::vector<std::vector<std::string>> rows{{"fabric", "pairs"}};
    for (const Measure measure : shownMeasures) rows.front().emplace_back(rowOf(measure).heading);
    for (const LeftOutFabric& fabric : result.fabrics)
        rows.push_back(cellsOf(fabric.fabric.value, std::to_string(fabric.pairs), fabric.predictors.front().values));
    const auto& predictors = result.fabrics.front().predictors;
    for (std::size_t i = 0; i < predictors.size(); ++i)
        rows.push_back(cellsOf(i == 0 ? "mean over fabrics" : "mean: " + predictors[i].name, "", meansOf(result, i)));
    std::string text = result.dataset + ": each fabric tested by a model that was trained without it\n" + leftOutLines(rows);
    for (const Measure measure : shownMeasures)
        text += "  " + std::string(rowOf(measure).heading) + ": " + std::string(rowOf(measure).meaning) + "\n";
    return text;
}

Json leaveOneOutJson(const LeaveOneOut& result)
{
    Json json{{"schema", "vis2hap.leave_one_out/1"}, {"dataset", result.dataset}, {"fabrics", Json::array()}};
    for (const LeftOutFabric& fabric : result.fabrics) json["fabrics"].push_back(leftOutJson(fabric));
    json["means"] = Json::array();
    if (result.fabrics.empty()) return json;
    const auto& predictors = result.fabrics.front().predictors;
    for (std::size_t i = 0; i < predictors.size(); ++i)
        json["means"].push_back(
            {{"id", predictors[i].id}, {"name", predictors[i].name}, {"values", valuesJson(meansOf(result, i))}});
    return json;
}

}  // namespace study::evaluation
