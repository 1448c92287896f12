#include "stats/models/explained_variance.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace stats {
namespace {

constexpr double logisticVariance = std::numbers::pi * std::numbers::pi / 3;

/// Number of answers under each of the model's conditions.
std::vector<double> rowsUnder(const CrossedStudy& study, const std::vector<std::string>& conditions)
{
    std::vector<double> counts(study.condition.levels.size());
    for (std::size_t row = 0; row < study.values.size(); ++row)
        if (!std::isnan(study.values[row])) ++counts[study.condition.of[row]];
    std::vector<double> ofModel;
    for (const std::string& condition : conditions) {
        const auto level = std::find(study.condition.levels.begin(), study.condition.levels.end(), condition);
        ofModel.push_back(counts[static_cast<std::size_t>(level - study.condition.levels.begin())]);
    }
    return ofModel;
}

/// Variance over the rows of the conditions' differences from the reference.
Value varianceOf(const std::vector<Value>& differences, const std::vector<double>& rows)
{
    if (differences.size() < 2) return Value::undefined("there is one condition only");
    double n = 0, mean = 0, squares = 0;
    for (std::size_t i = 0; i < differences.size(); ++i) {
        if (!differences[i].exists()) return differences[i];
        n += rows[i];
        mean += rows[i] * *differences[i];
    }
    mean /= n;
    for (std::size_t i = 0; i < differences.size(); ++i) squares += rows[i] * std::pow(*differences[i] - mean, 2);
    return squares / (n - 1);
}

/// `fixed`: treatment-coded effects, the intercept first.
template <class Effect, class EstimateOf>
std::vector<Value> differencesOf(const std::vector<Effect>& fixed, const EstimateOf& estimateOf)
{
    std::vector<Value> differences;
    // A separated reference condition leaves no difference.
    for (const Effect& effect : fixed)
        differences.push_back(differences.empty() && estimateOf(effect).exists() ? Value(0.0) : estimateOf(effect));
    return differences;
}

ExplainedVariance refused(const std::string& why)
{
    const Value none = Value::undefined(why);
    return {why, {}, none, none, none};
}

/// Shares and R squared; the residual is the last component.
void putShares(ExplainedVariance& result)
{
    double sum = 0;
    for (const VarianceComponent& component : result.components) {
        if (!component.variance.exists()) {
            result.marginal = result.conditional = component.variance;
            for (VarianceComponent& each : result.components) each.share = component.variance;
            return;
        }
        sum += *component.variance;
    }
    for (VarianceComponent& component : result.components)
        component.share = sum > 0 ? Value(*component.variance / sum) : Value::undefined("nothing varies but the conditions");
    result.marginal = result.conditional = result.conditionVariance;
    if (!result.conditionVariance.exists()) return;
    const double all = *result.conditionVariance + sum;
    result.marginal = *result.conditionVariance / all;
    result.conditional = 1 - *result.components.back().variance / all;
}

}  // namespace

ExplainedVariance explainedVariance(const CrossedStudy& study, const RatingModel& fitted)
{
    const MixedModel& model = fitted.model;
    if (!model.why.empty()) return refused(model.why);
    ExplainedVariance result;
    for (const RandomEffect& effect : model.random)
        result.components.push_back({effect.name, effect.variance, effect.sd, {}, effect.zero});
    result.components.push_back({"Residual", model.residualVariance, model.residualSd, {}, false});
    result.conditionVariance =
        varianceOf(differencesOf(model.fixed, [](const FixedEffect& effect) { return effect.test.estimate; }),
                   rowsUnder(study, fitted.conditions));
    putShares(result);
    return result;
}

ExplainedVariance explainedVariance(const CrossedStudy& study, const ChoiceModel& fitted)
{
    const LogisticMixedModel& model = fitted.model;
    if (!model.why.empty()) return refused(model.why);
    ExplainedVariance result;
    for (const RandomIntercept& effect : model.random)
        result.components.push_back(
            {effect.name, effect.sd.exists() ? Value(*effect.sd * *effect.sd) : effect.sd, effect.sd, {}, effect.zero});
    result.components.push_back({"Residual", logisticVariance, std::sqrt(logisticVariance), {}, false});
    result.conditionVariance = varianceOf(differencesOf(model.fixed, [](const LogOdds& effect) { return effect.estimate; }),
                                          rowsUnder(study, fitted.conditions));
    putShares(result);
    return result;
}

}  // namespace stats
