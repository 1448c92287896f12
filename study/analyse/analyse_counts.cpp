#include "study/analyse/analyse_counts.h"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "stats/models/psychometric_function.h"
#include "stats/tests/binomial.h"
#include "stats/tests/forced_choice.h"
#include "stats/tests/mcnemar.h"
#include "stats/tests/multiplicity.h"
#include "study/analyse/analyse_answer.h"
#include "study/analyse/analyse_inputs.h"

namespace study::analyse {

namespace {

using nlohmann::ordered_json;

constexpr NamedChoice<stats::Adjustment> adjustments[] = {{"holm", stats::Adjustment::Holm},
                                                          {"hochberg", stats::Adjustment::Hochberg},
                                                          {"bonferroni", stats::Adjustment::Bonferroni},
                                                          {"BH", stats::Adjustment::BenjaminiHochberg},
                                                          {"fdr", stats::Adjustment::BenjaminiHochberg},
                                                          {"BY", stats::Adjustment::BenjaminiYekutieli}};

ordered_json binomial(const AnalysisRequest& request)
{
    const double confidence = confidenceLevelOf(request.options);
    const auto b = stats::binomialTest(wholeAt(request.inputs, "k"), wholeAt(request.inputs, "n"),
                                       numberAt(request.options, "p0"), confidence);
    if (!b.why.empty()) return degenerate(b.why);
    AnswerFields answer;
    answer.put("estimate", b.estimate).putProbability("p_greater", b.pGreater, b.logPGreater).put("log_p_greater", b.logPGreater);
    answer.put("p_less", b.pLess).putProbability("p_two_sided_minlike", b.pTwoSided, b.logPTwoSided);
    answer.putProbability("p_mid_greater", b.pMidGreater, b.logPMidGreater).put("cp", b.clopperPearson).put("wilson", b.wilson);
    return answer.json();
}

ordered_json forcedChoice(const AnalysisRequest& request)
{
    const long long alternatives = wholeAt(request.inputs, "m");
    if (alternatives < 2 || alternatives > 1000000) throw RequestFault("m must lie between 2 and 1000000");
    const auto f =
        stats::forcedChoice(wholeAt(request.inputs, "k"), wholeAt(request.inputs, "n"), static_cast<int>(alternatives));
    if (!f.why.empty()) return degenerate(f.why);
    AnswerFields answer;
    answer.put("pc", f.proportionCorrect).put("p_discriminators", f.discriminators).put("d_prime", f.dPrime);
    if (std::isinf(f.dPrime.orElse(0)))
        answer.explain("d_prime", "every choice was correct, so the likelihood has no maximum at a finite d'");
    return answer.put("se_d_prime", f.seDPrime).json();
}

/// "lapse" is a fixed rate, or "estimate".
stats::LapseRate lapseOf(const AnalysisRequest& request)
{
    stats::LapseRate lapse;
    lapse.most = numberOr(request.options, "lapse_max", lapse.most);
    lapse.estimated = request.options.contains("lapse") && request.options["lapse"] == "estimate";
    if (!lapse.estimated) lapse.fixed = numberOr(request.options, "lapse", 0);
    return lapse;
}

void putEstimate(AnswerFields& answer, const std::string& name, const stats::PsychometricEstimate& of)
{
    answer.put(name, of.estimate).put("se_" + name, of.se).put(name + "_wald", of.wald).put(name + "_profile", of.profile);
}

constexpr double mostStimulusLevels = 1e5;  // a fit passes over them some hundred times
constexpr double mostAdjusted = 1e6;        // p values: about 200 bytes each

ordered_json psychometric(const AnalysisRequest& request)
{
    const auto levels = numbersAt(request.inputs, "level"), correct = numbersAt(request.inputs, "k"),
               trials = numbersAt(request.inputs, "n");
    if (levels.size() != correct.size() || levels.size() != trials.size())
        throw RequestFault("level, k and n differ in length; expected one of each for every level");
    checkSize("levels", static_cast<double>(levels.size()), mostStimulusLevels);
    std::vector<stats::LevelCounts> counts;
    for (std::size_t i = 0; i < levels.size(); ++i) counts.push_back({levels[i], correct[i], trials[i]});
    stats::PsychometricOptions options;
    const long long alternatives = wholeAt(request.inputs, "m");
    if (alternatives < 2 || alternatives > 1000000) throw RequestFault("m must lie between 2 and 1000000");
    options.alternatives = static_cast<int>(alternatives);
    options.lapse = lapseOf(request);
    options.confidence = confidenceLevelOf(request.options);
    if (request.options.contains("threshold_at")) options.thresholdAt = numberAt(request.options, "threshold_at");
    const auto fit = stats::fitPsychometricFunction(counts, options);
    if (!fit.why.empty()) return degenerate(fit.why);
    AnswerFields answer;
    answer.putCount("levels", fit.levels).put("trials", fit.trials);
    putEstimate(answer, "mu", fit.mu);
    putEstimate(answer, "sigma", fit.sigma);
    putEstimate(answer, "threshold", fit.threshold);
    answer.put("lapse", fit.lapse).put("se_lapse", fit.seLapse).putText("lapse_at_limit", fit.lapseAtLimit);
    answer.put("logLik", fit.logLikelihood).put("deviance", fit.deviance).put("df", fit.df).put("p_deviance", fit.p);
    return answer.putText("fitted", fit.fitted).json();
}

ordered_json mcnemar(const AnalysisRequest& request)
{
    const auto m = stats::mcnemarTest(wholeAt(request.inputs, "b"), wholeAt(request.inputs, "c"));
    if (!m.why.empty()) return degenerate(m.why);
    AnswerFields answer;
    answer.putProbability("p_exact", m.pExact, m.logPExact).putProbability("p_midp", m.pMid, m.logPMid);
    answer.put("chi2", m.chiSquared).put("p_chi2", m.pChiSquared);
    return answer.put("chi2_cc", m.chiSquaredCorrected).put("p_chi2_cc", m.pChiSquaredCorrected).json();
}

ordered_json pAdjust(const AnalysisRequest& request)
{
    const auto method = choiceOr(request.options, "method", adjustments, "holm");
    const auto values = numbersAt(request.inputs, "p");
    checkSize("p values", static_cast<double>(values.size()), mostAdjusted);
    std::vector<stats::Value> p;
    for (const double value : values) {
        if (value < 0 || value > 1) throw RequestFault("value " + std::to_string(p.size() + 1) + " of p lies outside 0 to 1");
        p.push_back(std::isnan(value) ? stats::Value::undefined("missing") : stats::Value(value));
    }
    ordered_json adjusted = ordered_json::array();
    for (const stats::Value& value : stats::adjusted(p, method))
        adjusted.push_back(numberJson(value.orElse(std::numeric_limits<double>::quiet_NaN())));
    return {{"adjusted", adjusted}};
}

}  // namespace

std::vector<NamedAnalysis> analysesOfCounts()
{
    return {
        {"binomial", binomial, "k n", "p0 [conf_level]", "exact binomial test with Clopper-Pearson and Wilson intervals"},
        {"mafc_dprime", forcedChoice, "k n m", "", "d' of an m-alternative forced choice"},
        {"mafc_probit", psychometric, "level k n m", "[lapse] [lapse_max] [threshold_at] [conf_level]",
         "psychometric function of an m-alternative forced choice"},
        {"mcnemar", mcnemar, "b c", "", "exact and mid-p McNemar test"},
        {"p_adjust", pAdjust, "p", "[method]", "p values adjusted for their number"},
    };
}

}  // namespace study::analyse
