#include "reports/json/model_json.h"

#include <nlohmann/json.hpp>

#include "reports/analysis/pair_comparisons.h"

namespace reports {
namespace {

void putLeftOutEffects(Json& part, const std::vector<stats::LeftOut>& leftOut)
{
    for (const stats::LeftOut& effect : leftOut) part["left_out"][effect.name] = effect.why;
}

}  // namespace

Json ratingModelJson(const stats::RatingModel& fitted)
{
    const stats::MixedModel& model = fitted.model;
    Json part{{"formula", fitted.formula}};
    putLeftOutEffects(part, fitted.leftOut);
    if (!model.why.empty()) {
        putNull(part, "F", model.why);
        return part;
    }
    part["fixef"] = part["se"] = part["var"] = Json::object();
    for (const stats::FixedEffect& effect : model.fixed) {
        put(part["fixef"], effect.name, effect.test.estimate);
        put(part["se"], effect.name, effect.test.se);
    }
    for (const stats::RandomEffect& effect : model.random) put(part["var"], effect.name, effect.variance);
    put(part["var"], "Residual", model.residualVariance);
    put(part, "REML_criterion", model.criterion);
    put(part, "F", fitted.condition.f);
    putWhole(part, "num_df", fitted.condition.df1);
    put(part, "den_df", fitted.condition.df2);
    putP(part, "p", fitted.condition.p, fitted.condition.logP);
    part["singular"] = model.singular;
    part["rows"] = model.rows;
    return part;
}

Json crossedChoiceModelJson(const stats::ChoiceModel& fitted)
{
    Json part = choiceModelJson(fitted);
    const stats::LogisticMixedModel& model = fitted.model;
    for (const stats::RandomIntercept& effect : model.random) {
        const std::size_t colon = effect.name.find(':');
        if (colon == std::string::npos) continue;
        part.erase("sd_" + effect.name);
        put(part, "sd_" + effect.name.substr(0, colon) + "_" + effect.name.substr(colon + 1), effect.sd);
    }
    if (model.why.empty()) put(part, "logLik_without_condition", model.logLikelihoodNull);
    return part;
}

Json modelContrastsJson(const StudyData& data, const std::vector<ModelContrast>& contrasts)
{
    Json rows = Json::array();
    for (const ModelContrast& contrast : contrasts) {
        Json row{{"a", contrast.a}, {"b", contrast.b}};
        const stats::MeanTest test = stats::testOfMean(contrast.mean, 0, stats::Tail::TwoSided);
        put(row, "estimate", contrast.mean.estimate);
        put(row, "se", contrast.mean.se);
        put(row, "df", contrast.mean.df);
        put(row, "t", test.t);
        putP(row, "p", test.p, test.logP);
        put(row, "ci95", contrast.mean.ci95);
        put(row, "ci90", contrast.mean.ci90);
        const auto [low, high] = boundsOf(data, contrast.a, contrast.b);
        Json tost{{"bounds", {low, high}}};
        const auto putTest = [&](const char* key, const stats::MeanTest& test) { putP(tost, key, test.p, test.logP); };
        putTest("p_lower", stats::testOfMean(contrast.mean, low, stats::Tail::Greater));
        putTest("p_upper", stats::testOfMean(contrast.mean, high, stats::Tail::Less));
        putTest("p", stats::equivalenceOfMean(contrast.mean, low, high));
        putReasonsLast(tost);
        row["tost"] = std::move(tost);
        putReasonsLast(row);
        rows.push_back(std::move(row));
    }
    return rows;
}

Json variancesJson(const stats::RatingModel& fitted)
{
    const stats::MixedModel& model = fitted.model;
    Json part{{"var", Json::object()}, {"sd", Json::object()}};
    for (const stats::RandomEffect& effect : model.random) {
        put(part["var"], effect.name, effect.variance);
        put(part["sd"], effect.name, effect.sd);
    }
    put(part["var"], "Residual", model.residualVariance);
    put(part["sd"], "Residual", model.residualSd);
    put(part, "REML_criterion", model.criterion);
    part["singular"] = model.singular;
    return part;
}

Json leaveOneFabricOutJson(const LeaveOneFabricOut& contrast)
{
    const auto row = [](Json start, const stats::CrossedMean& mean) {
        put(start, "estimate", mean.estimate);
        put(start, "se", mean.se);
        put(start, "df", mean.df);
        put(start, "ci90", mean.ci90);
        start["singular"] = mean.singular;
        putReasonsLast(start);
        return start;
    };
    Json part = Json::object();
    if (!contrast.why.empty()) {
        putNull(part, "all", contrast.why);
        return part;
    }
    part["a"] = contrast.a;
    part["b"] = contrast.b;
    part["all"] = row(Json::object(), contrast.all);
    part["without"] = Json::array();
    for (const FabricLeftOut& one : contrast.without) part["without"].push_back(row({{"fabric", one.fabric}}, one.mean));
    return part;
}

Json choiceModelJson(const stats::ChoiceModel& fitted)
{
    const stats::LogisticMixedModel& model = fitted.model;
    Json part{{"method", "Laplace"}, {"formula", fitted.formula}};
    putLeftOutEffects(part, fitted.leftOut);
    if (!model.why.empty()) {
        putNull(part, "lrt_chi2", model.why);
        return part;
    }
    part["fixef"] = part["se"] = Json::object();
    for (const stats::LogOdds& effect : model.fixed) {
        put(part["fixef"], effect.name, effect.estimate);
        put(part["se"], effect.name, effect.se);
    }
    for (const stats::RandomIntercept& effect : model.random) put(part, "sd_" + effect.name, effect.sd);
    put(part, "logLik", model.logLikelihood);
    put(part, "lrt_chi2", model.chiSquared);
    putWhole(part, "lrt_df", model.df);
    putP(part, "lrt_p", model.p, model.logP);
    // The reference report says here whether R's fit warned. Ours says why such a fit would warn.
    part["warn"] = model.separation != stats::Separation::None;
    if (!model.separationWhy.empty()) part["separation"] = model.separationWhy;
    part["singular"] = model.singular;
    part["rows"] = model.rows;
    return part;
}

void putGeneralisation(Json& part, const std::vector<stats::LeftOut>& leftOut)
{
    const std::string why = stats::whyNotForOthers(leftOut);
    if (why.empty())
        part["generalises_to"] = "fabrics_like_these";
    else
        putNull(part, "generalises_to", why);
}

}  // namespace reports
