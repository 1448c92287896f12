#include "reports/json/ordinal_json.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "protocols/files/number_text.h"

namespace reports {
namespace {

/// 5, not 5.0.
Json levelJson(double level)
{
    return std::nearbyint(level) == level && std::fabs(level) < 1e15 ? Json(static_cast<std::int64_t>(level)) : Json(level);
}

/// "4|5".
std::string thresholdName(const stats::Threshold& threshold)
{
    return protocols::shortest(threshold.below) + "|" + protocols::shortest(threshold.above);
}

void putLevels(Json& part, const stats::OrdinalMixedModel& model)
{
    part["levels"] = part["counts"] = Json::array();
    for (const double level : model.levels) part["levels"].push_back(levelJson(level));
    for (const std::size_t count : model.counts) part["counts"].push_back(count);
}

void putEstimates(Json& part, const stats::OrdinalMixedModel& model)
{
    part["fixef"] = part["se"] = part["thresholds"] = part["thresholds_se"] = Json::object();
    for (const stats::LogOdds& effect : model.fixed) {
        put(part["fixef"], effect.name, effect.estimate);
        put(part["se"], effect.name, effect.se);
    }
    for (const stats::Threshold& threshold : model.thresholds) {
        put(part["thresholds"], thresholdName(threshold), threshold.estimate);
        put(part["thresholds_se"], thresholdName(threshold), threshold.se);
    }
    for (const stats::RandomIntercept& effect : model.random) put(part, "sd_" + effect.name, effect.sd);
}

/// Remarks on the fit, as R's fit would have warnings.
Json messagesOf(const stats::OrdinalMixedModel& model)
{
    Json messages = Json::array();
    if (!model.separationWhy.empty()) messages.push_back(model.separationWhy);
    for (const stats::RandomIntercept& effect : model.random)
        if (effect.zero) messages.push_back("singular: the SD of " + effect.name + " was estimated as zero");
    return messages;
}

}  // namespace

Json ordinalRatingsJson(const std::string& question, const OrdinalRatings& ratings)
{
    const stats::OrdinalMixedModel& model = ratings.fitted.model;
    Json part{{"question", question},
              {"rounding", roundingWords(ratings.unit)},
              {"link", "logit: P(y <= j) = plogis(threshold_j - effect)"}};
    if (!ratings.fitted.formula.empty()) part["formula"] = ratings.fitted.formula;
    part["method"] = "Laplace";
    for (const stats::LeftOut& effect : ratings.fitted.leftOut) part["left_out"][effect.name] = effect.why;
    if (!ratings.why.empty()) {
        putNull(part, "logLik", ratings.why);
        return part;
    }
    putLevels(part, model);
    put(part, "logLik", model.logLikelihood);
    putEstimates(part, model);
    part["messages"] = messagesOf(model);
    putReasonsLast(part);
    return part;
}

}  // namespace reports
