#include "reports/json/speed_json.h"

#include <nlohmann/json.hpp>

namespace reports {
namespace {

const char* const onlyTheseFabrics = "these_fabrics";

void putMeanTest(Json& row, const stats::TTest& test)
{
    row["n"] = test.n;
    put(row, "estimate", test.estimate);
    put(row, "ci95", test.ci);
    put(row, "statistic", test.t);
    putWhole(row, "df", test.df);
    putP(row, "p", test.p, test.logP);
}

void addSpeedRow(Json& rows, const SpeedContrast& contrast, const std::string& measure, const stats::SpeedDifference& difference)
{
    Json row{{"a", contrast.a},
             {"b", contrast.b},
             {"measure", measure},
             {"primary", contrast.primary},
             {"planned", contrast.planned},
             {"generalises_to", onlyTheseFabrics}};
    putMeanTest(row, difference.test);
    putP(row, "p_holm", difference.pHolm);
    putReasonsLast(row);
    rows.push_back(std::move(row));
}

Json binRows(const std::vector<SpeedBin>& bins)
{
    Json rows = Json::array();
    for (std::size_t i = 0; i < bins.size(); ++i) {
        Json row{{"bin", i + 1}, {"choices", bins[i].choices}, {"participants", bins[i].participants}};
        put(row, "mean_seconds", bins[i].meanSeconds);
        put(row, "proportion", bins[i].share);
        put(row, "ci95", bins[i].ci95);
        putReasonsLast(row);
        rows.push_back(std::move(row));
    }
    return rows;
}

Json contrastPart(const ContrastWithoutTrend& contrast)
{
    Json part = Json::object();
    if (!contrast.why.empty()) {
        putNull(part, "difference", contrast.why);
        putNull(part, "without_trend", contrast.why);
        return part;
    }
    part = {{"a", contrast.a}, {"b", contrast.b}, {"primary", contrast.primary}, {"picked_from", contrast.pickedFrom}};
    const auto testPart = [](const stats::TTest& test) {
        Json row = Json::object();
        putMeanTest(row, test);
        putReasonsLast(row);
        return row;
    };
    part["difference"] = testPart(contrast.plain);
    part["without_trend"] = testPart(contrast.adjusted);
    return part;
}

}  // namespace

Json speedContrastsJson(const SpeedAnalysis& speed)
{
    Json part = Json::object();
    if (speed.contrasts.empty()) {
        putNull(part, "contrasts", speed.contrastsWhy);
        return part;
    }
    Json rows = Json::array();
    for (const SpeedContrast& contrast : speed.contrasts) {
        addSpeedRow(rows, contrast, "bits_per_second", contrast.tests.bitsPerSecond);
        addSpeedRow(rows, contrast, "bis", contrast.tests.score);
        addSpeedRow(rows, contrast, "log_seconds", contrast.tests.logSeconds);
    }
    part["contrasts"] = std::move(rows);
    return part;
}

Json accuracyBySpeedJson(const std::vector<std::string>& conditions, const AccuracyBySpeed& accuracy)
{
    Json part = Json::object();
    if (accuracy.bins.empty())
        putNull(part, "bins", accuracy.why);
    else
        part["bins"] = binRows(accuracy.bins);
    Json byCondition = Json::object();
    for (std::size_t c = 0; c < conditions.size(); ++c)
        if (accuracy.conditions[c].empty())
            putNull(byCondition, conditions[c], accuracy.why.empty() ? "nobody has enough timed choices" : accuracy.why);
        else
            byCondition[conditions[c]] = binRows(accuracy.conditions[c]);
    putReasonsLast(byCondition);
    part["conditions"] = std::move(byCondition);
    Json trend{{"generalises_to", onlyTheseFabrics}, {"per", "doubling of the response time"}};
    putMeanTest(trend, accuracy.trend.test);
    putReasonsLast(trend);
    part["trend"] = std::move(trend);
    putReasonsLast(part);
    return part;
}

Json orderEffectsJson(const OrderEffects& effects)
{
    Json part{{"generalises_to", onlyTheseFabrics}};
    if (!effects.why.empty()) {
        putNull(part, "questions", effects.why);
        return part;
    }
    // A question may be called "why": its object holds no reasons of its own.
    Json questions = Json::object();
    for (const QuestionOrder& question : effects.questions) {
        Json row = Json::object();
        for (const OrderEffect& effect : question.effects) {
            Json one = Json::object();
            putMeanTest(one, effect.trend.test);
            putP(one, "p_holm", effect.pHolm);
            putReasonsLast(one);
            row[keyOf(effect.kind)] = std::move(one);
        }
        row["contrast"] = contrastPart(question.contrast);
        questions[question.question] = std::move(row);
    }
    part["questions"] = std::move(questions);
    return part;
}

std::string keyOf(OrderEffectKind kind)
{
    switch (kind) {
        case OrderEffectKind::Trend:
            return "trend_per_10_trials";
        case OrderEffectKind::TimeTrend:
            return "log_seconds_per_10_trials";
        case OrderEffectKind::LaterSittings:
            break;
    }
    return "later_minus_first_sitting";
}

}  // namespace reports
