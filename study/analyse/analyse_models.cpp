#include "study/analyse/analyse_models.h"

#include <array>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include "stats/claims/crossed_mean.h"
#include "stats/kernels/decimal_grid.h"
#include "stats/models/crossed_study.h"
#include "stats/models/explained_variance.h"
#include "stats/tests/multiplicity.h"
#include "study/analyse/analyse_answer.h"
#include "study/analyse/analyse_inputs.h"

namespace study::analyse {

namespace {

using nlohmann::ordered_json;
using stats::Value;

enum class Terms { Main, Crossed };
constexpr NamedChoice<Terms> termsByName[] = {{"main", Terms::Main}, {"crossed", Terms::Crossed}};

ordered_json leftOutJson(const std::vector<stats::LeftOut>& leftOut)
{
    ordered_json list = ordered_json::array();
    for (const stats::LeftOut& one : leftOut) list.push_back({{"name", one.name}, {"why", one.why}});
    return list;
}

/// Random intercepts of participant and fabric only.
stats::RatingModel fitMainEffects(const stats::CrossedStudy& whole, const stats::MixedModelOptions& options)
{
    std::vector<std::size_t> rows;
    for (std::size_t row = 0; row < whole.values.size(); ++row)
        if (!std::isnan(whole.values[row])) rows.push_back(row);
    stats::RatingModel result;
    result.formula = "y~condition";
    const stats::Factor condition = stats::rowsOf(whole.condition, rows);
    stats::MixedModelData data{{}, stats::treatmentCoded(condition), {}};
    for (const std::size_t row : rows) data.y.push_back(whole.values[row]);
    for (const stats::Factor* group : {&whole.participant, &whole.fabric}) {
        stats::Factor present = stats::rowsOf(*group, rows);
        if (present.levels.size() < 2)
            result.leftOut.push_back({group->name, "has one level only"});
        else if (present.levels.size() >= rows.size())
            result.leftOut.push_back({group->name, "has a level for every value, as the residual"});
        else {
            result.formula += "+(1|" + group->name + ")";
            data.random.push_back({std::move(present), {}, ""});
        }
    }
    result.conditions = condition.levels;
    result.model = stats::fitMixedModel(data, options);
    result.model.missing = whole.values.size() - rows.size();
    result.condition = stats::effectTest(result.model);
    return result;
}

void putFixed(AnswerFields& answer, const std::vector<stats::FixedEffect>& fixed)
{
    std::vector<std::string> names;
    std::vector<Value> estimates, errors, degrees, t, p, logP;
    for (const stats::FixedEffect& effect : fixed) {
        names.push_back(effect.name);
        estimates.push_back(effect.test.estimate);
        errors.push_back(effect.test.se);
        degrees.push_back(effect.test.df);
        t.push_back(effect.test.t);
        p.push_back(effect.test.p);
        logP.push_back(effect.test.logP);
    }
    answer.put("fixef", names, estimates).put("se", names, errors).put("df", names, degrees);
    answer.put("t", names, t).put("p", names, p).put("log_p", names, logP);
}

void putVariances(AnswerFields& answer, const stats::MixedModel& model)
{
    std::vector<std::string> names;
    std::vector<Value> variances, sds;
    for (const stats::RandomEffect& effect : model.random) {
        names.push_back(effect.name);
        variances.push_back(effect.variance);
        sds.push_back(effect.sd);
    }
    names.emplace_back("Residual");
    variances.push_back(model.residualVariance);
    sds.push_back(model.residualSd);
    answer.put("var", names, variances).put("sd", names, sds);
}

ordered_json contrastsJson(const stats::RatingModel& fit, const nlohmann::json& options)
{
    const auto bounds = boundsOf(options);
    std::vector<std::pair<stats::ContrastTest, std::pair<std::size_t, std::size_t>>> tests;
    std::vector<Value> p;
    for (const auto& pair : contrastsOf(options, fit.conditions)) {
        tests.emplace_back(stats::levelDifference(fit.model, pair.first, pair.second), pair);
        p.push_back(tests.back().first.p);
    }
    const auto holm = stats::adjusted(p, stats::Adjustment::Holm);
    ordered_json rows = ordered_json::array();
    for (std::size_t i = 0; i < tests.size(); ++i) {
        const auto& [test, pair] = tests[i];
        const stats::CrossedMean mean = stats::crossedMean(test);
        AnswerFields row;
        row.putText("a", fit.conditions[pair.first]).putText("b", fit.conditions[pair.second]).put("estimate", test.estimate);
        row.put("se", test.se).put("df", test.df).put("t", test.t).putProbability("p", test.p, test.logP);
        row.put("log_p", test.logP).put("p_adjusted", holm[i]).put("ci90", mean.ci90).put("ci95", mean.ci95);
        if (bounds) {
            const stats::MeanTest equivalence = stats::equivalenceOfMean(mean, bounds->first, bounds->second);
            row.putProbability("p_equivalence", equivalence.p, equivalence.logP);
        }
        rows.push_back(row.json());
    }
    return rows;
}

ordered_json linearMixed(const AnalysisRequest& request)
{
    const stats::CrossedStudy rows = crossedRowsAt(request.inputs, "value");
    const bool reml = truthOr(request.options, "reml", true);
    const auto terms = choiceOr(request.options, "terms", termsByName, "crossed");
    const stats::RatingModel fit =
        terms == Terms::Crossed ? stats::fitRatings(rows, {reml, 0.95}) : fitMainEffects(rows, {reml, 0.95});
    if (!fit.model.why.empty()) return degenerate(fit.model.why);
    AnswerFields answer;
    answer.putText("formula", fit.formula).putText("method", reml ? "REML" : "ML").putCount("rows", fit.model.rows);
    answer.putCount("n_missing", fit.model.missing);
    putFixed(answer, fit.model.fixed);
    putVariances(answer, fit.model);
    answer.put("criterion", fit.model.criterion).putText("singular", fit.model.singular);
    answer.put("F", fit.condition.f).put("F_df1", fit.condition.df1).put("F_df2", fit.condition.df2);
    answer.putProbability("F_p", fit.condition.p, fit.condition.logP).put("F_log_p", fit.condition.logP);
    answer.putText("contrasts", contrastsJson(fit, request.options)).putText("left_out", leftOutJson(fit.leftOut));
    return answer.json();
}

void putLogOdds(AnswerFields& answer, const std::vector<stats::LogOdds>& fixed)
{
    std::vector<std::string> names;
    std::vector<Value> estimates, errors, z, p, logP, low, high;
    for (const stats::LogOdds& effect : fixed) {
        names.push_back(effect.name);
        estimates.push_back(effect.estimate);
        errors.push_back(effect.se);
        z.push_back(effect.z);
        p.push_back(effect.p);
        logP.push_back(effect.logP);
        low.push_back(effect.ci.low);
        high.push_back(effect.ci.high);
    }
    answer.put("fixef", names, estimates).put("se", names, errors).put("z", names, z).put("p", names, p);
    answer.put("log_p", names, logP).put("ci_low", names, low).put("ci_high", names, high);
}

void putSds(AnswerFields& answer, const std::vector<stats::RandomIntercept>& random)
{
    std::vector<std::string> names;
    std::vector<Value> sds;
    for (const stats::RandomIntercept& intercept : random) {
        names.push_back(intercept.name);
        sds.push_back(intercept.sd);
    }
    answer.put("sd", names, sds);
}

ordered_json logisticMixed(const AnalysisRequest& request)
{
    const stats::CrossedStudy rows = crossedRowsAt(request.inputs, "correct");
    const auto terms = choiceOr(request.options, "terms", termsByName, "crossed");
    const stats::ChoiceModel fit =
        stats::fitChoices(rows, terms == Terms::Crossed ? stats::ChoiceTerms::WithInteractions : stats::ChoiceTerms::MainEffects,
                          confidenceLevelOf(request.options));
    const stats::LogisticMixedModel& model = fit.model;
    if (!model.why.empty()) return degenerate(model.why);
    AnswerFields answer;
    answer.putText("formula", fit.formula).putText("method", "Laplace").putCount("rows", model.rows);
    answer.putCount("n_missing", model.missing);
    putLogOdds(answer, model.fixed);
    putSds(answer, model.random);
    answer.put("logLik", model.logLikelihood).put("logLik_without_condition", model.logLikelihoodNull);
    answer.put("lrt_chi2", model.chiSquared).put("lrt_df", model.df).putProbability("lrt_p", model.p, model.logP);
    answer.put("lrt_log_p", model.logP).putText("singular", model.singular);
    answer.putText("separation", model.separationWhy.empty() ? ordered_json() : ordered_json(model.separationWhy));
    return answer.putText("left_out", leftOutJson(fit.leftOut)).json();
}

std::string shortestText(double number)
{
    std::array<char, 32> text{};
    return {text.data(), std::to_chars(text.data(), text.data() + text.size(), number).ptr};
}

/// The estimates between neighbouring categories, named as in R: "4|5".
void putThresholds(AnswerFields& answer, const std::vector<stats::Threshold>& thresholds)
{
    std::vector<std::string> names;
    std::vector<Value> estimates, errors;
    for (const stats::Threshold& threshold : thresholds) {
        names.push_back(shortestText(threshold.below) + "|" + shortestText(threshold.above));
        estimates.push_back(threshold.estimate);
        errors.push_back(threshold.se);
    }
    answer.put("thresholds", names, estimates).put("thresholds_se", names, errors);
}

ordered_json ordinalMixed(const AnalysisRequest& request)
{
    stats::CrossedStudy rows = crossedRowsAt(request.inputs, "rating");
    const double unit = numberOr(request.options, "round_to", 0);
    if (unit != 0 && unit != 0.1 && unit != 0.5 && unit != 1 && unit != 10)
        throw RequestFault("round_to must be 0.1, 0.5, 1 or 10; or absent, and each value is a category");
    if (unit != 0) rows.values = stats::roundedHalvesUp(rows.values, unit);
    const stats::OrdinalRatingModel fit = stats::fitOrdinal(rows, {confidenceLevelOf(request.options), true});
    const stats::OrdinalMixedModel& model = fit.model;
    if (!model.why.empty()) return degenerate(model.why);
    AnswerFields answer;
    answer.putText("formula", fit.formula).putText("method", "Laplace").putCount("rows", model.rows);
    answer.putCount("n_missing", model.missing).putText("levels", model.levels).putText("counts", model.counts);
    putLogOdds(answer, model.fixed);
    putThresholds(answer, model.thresholds);
    putSds(answer, model.random);
    answer.put("logLik", model.logLikelihood).put("logLik_without_condition", model.logLikelihoodNull);
    answer.put("lrt_chi2", model.test.chiSquared).put("lrt_df", model.test.df);
    answer.putProbability("lrt_p", model.test.p, model.test.logP).put("lrt_log_p", model.test.logP);
    answer.putText("singular", model.singular);
    answer.putText("separation", model.separationWhy.empty() ? ordered_json() : ordered_json(model.separationWhy));
    return answer.putText("left_out", leftOutJson(fit.leftOut)).json();
}

ordered_json explainedJson(const stats::ExplainedVariance& explained, const std::string& formula, const std::string& scale,
                           const std::vector<stats::LeftOut>& leftOut)
{
    if (!explained.why.empty()) return degenerate(explained.why);
    std::vector<std::string> names;
    std::vector<Value> variances, shares;
    for (const stats::VarianceComponent& component : explained.components) {
        names.push_back(component.name);
        variances.push_back(component.variance);
        shares.push_back(component.share);
    }
    AnswerFields answer;
    answer.putText("formula", formula).putText("scale", scale).put("marginal", explained.marginal);
    answer.put("conditional", explained.conditional).put("condition_variance", explained.conditionVariance);
    answer.put("var", names, variances).put("share", names, shares);
    return answer.putText("left_out", leftOutJson(leftOut)).json();
}

enum class Scale { Linear, Logistic };
constexpr NamedChoice<Scale> scalesByName[] = {{"linear", Scale::Linear}, {"logistic", Scale::Logistic}};

ordered_json rSquared(const AnalysisRequest& request)
{
    const stats::CrossedStudy rows = crossedRowsAt(request.inputs, "value");
    const bool crossed = choiceOr(request.options, "terms", termsByName, "crossed") == Terms::Crossed;
    if (choiceOr(request.options, "model", scalesByName, "linear") == Scale::Logistic) {
        const stats::ChoiceModel fit =
            stats::fitChoices(rows, crossed ? stats::ChoiceTerms::WithInteractions : stats::ChoiceTerms::MainEffects);
        return explainedJson(stats::explainedVariance(rows, fit), fit.formula, "log_odds", fit.leftOut);
    }
    const stats::RatingModel fit = crossed ? stats::fitRatings(rows) : fitMainEffects(rows, {});
    return explainedJson(stats::explainedVariance(rows, fit), fit.formula, "value", fit.leftOut);
}

}  // namespace

std::vector<NamedAnalysis> analysesOfModels()
{
    return {
        {"linear_mixed", linearMixed, "value condition participant [fabric]", "[terms] [reml] [contrasts] [bounds]",
         "linear mixed model with Satterthwaite's degrees of freedom; terms: main or crossed"},
        {"logistic_mixed", logisticMixed, "correct condition participant [fabric]", "[terms] [conf_level]",
         "logistic mixed model by Laplace's approximation; terms: main or crossed"},
        {"ordinal_mixed", ordinalMixed, "rating condition participant [fabric]", "[round_to] [conf_level]",
         "cumulative logit mixed model of ratings in categories"},
        {"r_squared", rSquared, "value condition participant [fabric]", "[model] [terms]",
         "marginal and conditional R squared of a mixed model; model: linear or logistic"},
    };
}

}  // namespace study::analyse
