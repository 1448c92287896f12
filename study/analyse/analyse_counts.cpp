#include "study/analyse/analyse_counts.h"

#include <cmath>
#include <limits>

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
    const double confidence = numberOr(request.options, "conf_level", 0.95);
    if (!(confidence > 0 && confidence < 1)) throw RequestFault("conf_level must lie between 0 and 1");
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
    std::vector<stats::Value> p;
    for (const double value : numbersAt(request.inputs, "p")) {
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
    return {{"binomial", binomial}, {"mafc_dprime", forcedChoice}, {"mcnemar", mcnemar}, {"p_adjust", pAdjust}};
}

}  // namespace study::analyse
