#include "reports/json/model_json.h"

#include <nlohmann/json.hpp>

namespace reports {
namespace {

void putLeftOut(Json& part, const std::vector<stats::LeftOut>& leftOut)
{
    for (const stats::LeftOut& effect : leftOut) part["left_out"][effect.name] = effect.why;
}

}  // namespace

Json ratingModelJson(const stats::RatingModel& fitted)
{
    const stats::MixedModel& model = fitted.model;
    Json part{{"formula", fitted.formula}};
    putLeftOut(part, fitted.leftOut);
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

Json choiceModelJson(const stats::ChoiceModel& fitted)
{
    const stats::LogisticMixedModel& model = fitted.model;
    Json part{{"method", "Laplace"}, {"formula", fitted.formula}};
    putLeftOut(part, fitted.leftOut);
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

}  // namespace reports
