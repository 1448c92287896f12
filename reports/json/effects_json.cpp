#include "reports/json/effects_json.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

namespace reports {
namespace {

Json reliabilityJson(const RaterAgreement& agreement)
{
    const stats::IntraclassCorrelations& icc = agreement.icc;
    const stats::IntraclassIntervals& ci = agreement.ci95;
    Json part{{"stimuli", agreement.stimuli}, {"raters", agreement.raters}, {"left_out", agreement.leftOut}};
    put(part, "ICC2", icc.icc2);
    put(part, "ICC2_ci95", ci.icc2);
    put(part, "ICC2k", icc.icc2k);
    put(part, "ICC2k_ci95", ci.icc2k);
    put(part, "ICC3", icc.icc3);
    put(part, "ICC3_ci95", ci.icc3);
    put(part, "ICC3k", icc.icc3k);
    put(part, "ICC3k_ci95", ci.icc3k);
    putReasonsLast(part);
    return part;
}

Json evidenceJson(const QuestionEffects& effects)
{
    Json part{{"prior_scale", stats::mediumPriorWidth}, {"generalises_to", "these_fabrics"}};
    if (!effects.noEvidence.empty()) {
        putNull(part, "contrasts", effects.noEvidence);
        return part;
    }
    part["contrasts"] = Json::array();
    for (const ContrastEvidence& one : effects.evidence) {
        Json row{{"a", one.a}, {"b", one.b}, {"planned", one.planned}, {"n", one.participants}};
        put(row, "t", one.t);
        put(row, "bf10", one.factor.bf10);
        const stats::Value& log = one.factor.logBf10;
        put(row, "log10_bf10", log.exists() ? stats::Value(*log / std::numbers::ln10) : log);
        putReasonsLast(row);
        part["contrasts"].push_back(std::move(row));
    }
    return part;
}

Json effectSizesJson(const QuestionEffects& effects)
{
    Json part{{"n", effects.completeParticipants}, {"generalises_to", "these_fabrics"}};
    put(part, "partial_eta_squared", effects.partialEtaSquared);
    put(part, "generalised_eta_squared", effects.generalizedEtaSquared);
    putReasonsLast(part);
    return part;
}

Json rSquaredJson(const stats::ExplainedVariance& variance, const std::string& unit)
{
    Json part{{"scale", unit}};
    put(part, "condition_variance", variance.conditionVariance);
    put(part, "marginal", variance.marginal);
    put(part, "conditional", variance.conditional);
    putReasonsLast(part);
    return part;
}

Json componentsJson(const QuestionEffects& effects, const std::string& unit)
{
    Json part{{"unit", unit}};
    if (!effects.variance.why.empty())
        putNull(part, "components", effects.variance.why);
    else
        for (const stats::VarianceComponent& component : effects.variance.components) {
            Json row{{"name", component.name}};
            put(row, "sd", component.sd);
            put(row, "variance", component.variance);
            put(row, "share", component.share);
            row["estimated_as_zero"] = component.isZero;
            putReasonsLast(row);
            part["components"].push_back(std::move(row));
        }
    part["left_out"] = Json::object();
    for (const stats::LeftOut& effect : effects.leftOut) part["left_out"][effect.name] = effect.why;
    part["meaning"] = fabricSentence(effects, unit);
    putReasonsLast(part);
    return part;
}

/// d' of a share, or at one end of its interval, with the reason where it is at the end of its range.
void putSensitivity(Json& row, const std::string& key, const stats::Value& dPrime)
{
    if (dPrime.exists() && std::isinf(*dPrime)) return putNull(row, key, "at a share of 1 d' has no upper bound");
    put(row, key, dPrime);
    if (dPrime.exists() && *dPrime == 0) row["note"] = "at or below chance d' is set to 0";
}

}  // namespace

std::vector<std::string> effectKeys()
{
    return {"reliability", "bayes_factors", "effect_sizes", "r_squared", "variance_components"};
}

void putEffects(Json& statistics, const std::string& question, const QuestionEffects& effects, const std::string& unit)
{
    if (effects.agreement) statistics["reliability"][question] = reliabilityJson(*effects.agreement);
    statistics["bayes_factors"][question] = evidenceJson(effects);
    statistics["effect_sizes"][question] = effectSizesJson(effects);
    statistics["r_squared"][question] = rSquaredJson(effects.variance, unit);
    statistics["variance_components"][question] = componentsJson(effects, unit);
}

Json clusteredSensitivityRows(const std::vector<ClusteredSensitivity>& sensitivities, const std::string& condition,
                              DPrimeRule rule)
{
    Json rows = Json::array();
    for (const ClusteredSensitivity& one : sensitivities) {
        if (one.condition != condition) continue;
        Json row{{"generalises_to", nameOf(one.generalisation)}};
        put(row, "share", one.share);
        put(row, "share_ci95", one.shareCi95);
        const auto putIndex = rule == DPrimeRule::OfShare
                                  ? &putSensitivity
                                  : +[](Json& to, const std::string& key, const stats::Value& index) { put(to, key, index); };
        putIndex(row, "d_prime", one.dPrime);
        putIndex(row, "d_prime_low", one.ci95.low);
        putIndex(row, "d_prime_high", one.ci95.high);
        putReasonsLast(row);
        rows.push_back(std::move(row));
    }
    return rows;
}

}  // namespace reports
