#include "study/analyse/analyse_designs.h"

#include <nlohmann/json.hpp>

#include "stats/anova/between_anova.h"
#include "stats/anova/within_anova.h"
#include "study/analyse/analyse_answer.h"
#include "study/analyse/analyse_inputs.h"

namespace study::analyse {

namespace {

using nlohmann::ordered_json;
using stats::SumsOfSquares;

enum class Design { Between, Within, Mixed };
constexpr NamedChoice<Design> designs[] = {{"between", Design::Between}, {"within", Design::Within}, {"mixed", Design::Mixed}};
constexpr NamedChoice<SumsOfSquares> types[] = {{"II", SumsOfSquares::TypeII}, {"III", SumsOfSquares::TypeIII}};

constexpr double mostMeasures = 1000;
constexpr double mostMeasureWork = 5e7;  // measures x measures x participants: some seconds

stats::TwoWayAnova anovaOf(const AnalysisRequest& request, Design design, SumsOfSquares type)
{
    const auto values = numbersAt(request.inputs, "value");
    const stats::Factor a = factorAt(request.inputs, "a"), b = factorAt(request.inputs, "b");
    const stats::Factor participant =
        design == Design::Between ? stats::Factor{"participant", {}, a.of} : factorAt(request.inputs, "participant");
    for (const stats::Factor* factor : {&a, &b, &participant})
        if (factor->of.size() != values.size()) throw RequestFault(factor->name + " and value differ in length");
    if (design != Design::Between) {  // the covariances of the repeated measures are a square matrix
        const auto levelsOf = [](const stats::Factor& factor) { return static_cast<double>(factor.levels.size()); };
        const double measures = levelsOf(b) * (design == Design::Within ? levelsOf(a) : 1);
        checkSize("measures of a participant", measures, mostMeasures);
        checkSize("measures x measures x participants", measures * measures * levelsOf(participant), mostMeasureWork);
    }
    switch (design) {
        case Design::Between:
            return stats::twoWayBetween(values, a, b, type);
        case Design::Within:
            return stats::twoWayWithin(values, participant, a, b);
        case Design::Mixed:
            break;
    }
    return stats::twoWayMixed(values, participant, a, b, type);
}

ordered_json effectJson(const stats::AnovaEffect& effect)
{
    if (!effect.why.empty()) return degenerate(effect.why);
    AnswerFields row;
    row.put("ss", effect.ss).put("ss_error", effect.ssError).put("df1", effect.df1).put("df2", effect.df2).put("F", effect.f);
    row.putProbability("p", effect.p, effect.logP).put("log_p", effect.logP).put("eta2_partial", effect.partialEtaSquared);
    row.put("eta2_generalized", effect.generalizedEtaSquared);
    if (!effect.within) return row.json();
    row.put("eps_gg", effect.epsilonGg).putProbability("p_gg", effect.pGg, effect.logPGg).put("log_p_gg", effect.logPGg);
    row.put("eps_hf", effect.epsilonHf).putProbability("p_hf", effect.pHf, effect.logPHf);
    row.put("mauchly_w", effect.mauchly.w).put("mauchly_chi2", effect.mauchly.chiSquared).put("mauchly_df", effect.mauchly.df);
    return row.put("mauchly_p", effect.mauchly.pSecondOrder).json();
}

ordered_json twoWayAnova(const AnalysisRequest& request)
{
    const auto design = choiceOr(request.options, "design", designs, "");
    const auto type = choiceOr(request.options, "ss_type", types, "III");
    const stats::TwoWayAnova anova = anovaOf(request, design, type);
    if (!anova.why.empty()) return degenerate(anova.why);
    AnswerFields answer;
    if (design == Design::Within)
        answer.putText("ss_type", ordered_json()).explain("ss_type", "complete participants make the design balanced");
    else
        answer.putText("ss_type", type == SumsOfSquares::TypeII ? "II" : "III");
    answer.putCount("values", anova.values).putCount("n_missing", anova.missing).putText("balanced", anova.balanced);
    if (design != Design::Between) answer.putCount("participants", anova.participants).putCount("n_dropped", anova.dropped);
    const std::array<const char*, 3> names{"a", "b", "a:b"};
    for (std::size_t i = 0; i < names.size(); ++i) answer.putText(names[i], effectJson(anova.effects[i]));
    return answer.json();
}

}  // namespace

std::vector<NamedAnalysis> analysesOfDesigns()
{
    return {{"two_way_anova", twoWayAnova, "value a b [participant]", "design [ss_type]",
             "two-way ANOVA; design: between, within, or mixed (a between, b within participants)"}};
}

}  // namespace study::analyse
