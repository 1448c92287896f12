#include "study/analyse/analyse_tables.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "stats/tests/friedman_exact.h"
#include "stats/tests/intraclass.h"
#include "stats/tests/one_way_anova.h"
#include "stats/tests/rank_tests.h"
#include "stats/tests/repeated_measures.h"
#include "study/analyse/analyse_answer.h"
#include "study/analyse/analyse_inputs.h"

namespace study::analyse {

namespace {

using nlohmann::ordered_json;

stats::BlockTable tableOf(const AnalysisRequest& request)
{
    auto result = stats::blockTableOf(rowsAt(request.inputs, "rows"));
    if (!result.fault.empty()) throw RequestFault(result.fault);
    return std::move(result.table);
}

constexpr double mostTableColumns = 1000;   // their covariances are a square matrix
constexpr double mostCovarianceWork = 5e7;  // columns x columns x rows: some seconds

ordered_json friedman(const AnalysisRequest& request)
{
    const auto table = tableOf(request);
    const auto f = stats::friedmanTest(table);
    if (!f.why.empty()) return degenerate(f.why);
    const auto exact = stats::exactFriedman(table);
    AnswerFields answer;
    answer.put("Q", f.q).put("df", f.df).putProbability("p", f.p, f.logP).put("log_p", f.logP).put("kendall_w", f.kendallW);
    answer.put("iman_davenport_F", f.imanDavenportF).put("F_df1", f.fDf1).put("F_df2", f.fDf2);
    answer.putProbability("F_p", f.fP, f.fLogP);
    return answer.putProbability("p_exact", exact.p, exact.logP).put("log_p_exact", exact.logP).json();
}

ordered_json cochran(const AnalysisRequest& request)
{
    const auto c = stats::cochranTest(tableOf(request));
    if (!c.why.empty()) return degenerate(c.why);
    AnswerFields answer;
    return answer.put("Q", c.q).put("df", c.df).putProbability("p", c.p, c.logP).put("log_p", c.logP).json();
}

ordered_json repeatedMeasures(const AnalysisRequest& request)
{
    const auto table = tableOf(request);
    const auto columns = static_cast<double>(table.conditions), rows = static_cast<double>(table.blocks);
    checkSize("conditions", columns, mostTableColumns);
    checkSize("conditions x conditions x rows", columns * columns * rows, mostCovarianceWork);
    const auto a = stats::repeatedMeasuresAnova(table);
    if (!a.why.empty()) return degenerate(a.why);
    AnswerFields answer;
    answer.put("ss_condition", a.ssCondition).put("ss_subject", a.ssSubject).put("ss_error", a.ssError);
    answer.put("F", a.f).put("df1", a.df1).put("df2", a.df2).putProbability("p", a.p, a.logP).put("log_p", a.logP);
    answer.put("eps_gg", a.epsilonGg).putProbability("p_gg", a.pGg, a.logPGg).put("log_p_gg", a.logPGg);
    answer.put("eps_hf_raw", a.epsilonHf);
    answer.put("eps_hf_used", a.epsilonHf.exists() ? stats::Value(std::min(1.0, *a.epsilonHf)) : a.epsilonHf);
    answer.putProbability("p_hf", a.pHf, a.logPHf);
    answer.put("eta2_partial", a.partialEtaSquared).put("eta2_generalized", a.generalizedEtaSquared);
    answer.put("morey_ci_halfwidth", a.moreyHalfWidths).put("mauchly_w", a.mauchly.w).put("mauchly_chi2", a.mauchly.chiSquared);
    answer.put("mauchly_df", a.mauchly.df)
        .put("mauchly_p_chi2", a.mauchly.pChiSquared)
        .put("mauchly_p_box2", a.mauchly.pSecondOrder);
    return answer.json();
}

ordered_json intraclass(const AnalysisRequest& request)
{
    const auto icc = stats::intraclassCorrelations(tableOf(request));
    if (!icc.why.empty()) return degenerate(icc.why);
    AnswerFields answer;
    answer.put("icc1_1", icc.icc1).put("icc2_1", icc.icc2).put("icc3_1", icc.icc3);
    answer.put("icc1_k", icc.icc1k).put("icc2_k", icc.icc2k).put("icc3_k", icc.icc3k).put("cronbach_alpha", icc.icc3k);
    return answer.json();
}

/// The arrays of "groups"; or the values "y" divided by their "group", in the order of first appearance.
std::vector<std::vector<double>> groupsOf(const AnalysisRequest& request)
{
    if (!request.inputs.contains("y")) return rowsAt(request.inputs, "groups");
    const auto y = numbersAt(request.inputs, "y");
    if (!request.inputs.contains("group") || !request.inputs["group"].is_array() || request.inputs["group"].size() != y.size())
        throw RequestFault("group must be an array as long as y");
    std::map<nlohmann::json, std::size_t> places;
    std::vector<std::vector<double>> groups;
    for (std::size_t i = 0; i < y.size(); ++i) {
        const auto [place, isNew] = places.emplace(request.inputs["group"][i], groups.size());
        if (isNew) groups.emplace_back();
        groups[place->second].push_back(y[i]);
    }
    return groups;
}

ordered_json oneWay(const AnalysisRequest& request)
{
    const auto a = stats::oneWayAnova(groupsOf(request));
    if (!a.why.empty()) return degenerate(a.why);
    AnswerFields answer;
    answer.putCount("n", a.n).putCount("k", a.groups).put("ss_between", a.ssBetween).put("ss_within", a.ssWithin);
    answer.put("ms_between", a.msBetween).put("ms_within", a.msWithin).put("df1", a.df1).put("df2", a.df2).put("F", a.f);
    answer.putProbability("p", a.p, a.logP).put("log_p", a.logP).put("r_squared", a.rSquared);
    return answer.put("omega_squared", a.omegaSquared).put("residual_sd", a.residualSd).json();
}

}  // namespace

std::vector<NamedAnalysis> analysesOfTables()
{
    return {
        {"friedman", friedman, "rows", "", "Friedman test with its exact p, Iman-Davenport F, Kendall's W"},
        {"cochran_q", cochran, "rows", "", "Cochran's Q of 0 and 1"},
        {"rm_anova_oneway", repeatedMeasures, "rows", "", "one-way repeated-measures ANOVA; rows are participants"},
        {"icc", intraclass, "rows", "", "intraclass correlations; rows are targets, columns raters"},
        {"anova_oneway", oneWay, "[groups] [y] [group]", "", "one-way ANOVA: groups, or y with group"},
        {"one_way_anova", oneWay, "[groups] [y] [group]", "", "another name of anova_oneway"},
        {"oneway_anova", oneWay, "[groups] [y] [group]", "", "another name of anova_oneway"},
    };
}

}  // namespace study::analyse
