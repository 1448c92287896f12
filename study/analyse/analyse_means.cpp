#include "study/analyse/analyse_means.h"

#include <nlohmann/json.hpp>

#include "stats/tests/bayes_factor.h"
#include "stats/tests/bootstrap.h"
#include "stats/tests/equivalence.h"
#include "stats/tests/sign_flip.h"
#include "stats/tests/t_tests.h"
#include "stats/tests/wilcoxon.h"
#include "study/analyse/analyse_answer.h"
#include "study/analyse/analyse_inputs.h"

namespace study::analyse {

namespace {

using nlohmann::ordered_json;

constexpr NamedChoice<stats::Tail> tails[] = {{"two-sided", stats::Tail::TwoSided},
                                              {"two_sided", stats::Tail::TwoSided},
                                              {"less", stats::Tail::Less},
                                              {"greater", stats::Tail::Greater}};
constexpr NamedChoice<stats::TKind> kinds[] = {{"one_sample", stats::TKind::OneSample},
                                               {"paired", stats::TKind::Paired},
                                               {"student", stats::TKind::Student},
                                               {"welch", stats::TKind::Welch}};
constexpr NamedChoice<stats::ZeroMethod> zeroMethods[] = {{"wilcox", stats::ZeroMethod::Wilcox},
                                                          {"pratt", stats::ZeroMethod::Pratt}};
constexpr NamedChoice<stats::Arithmetic> arithmetics[] = {{"double", stats::Arithmetic::Double},
                                                          {"decimal", stats::Arithmetic::Decimal}};

stats::Tail tailOf(const AnalysisRequest& request) { return choiceOr(request.options, "alternative", tails, "two-sided"); }

/// The data of a t test; y is empty for a test of one sample.
struct TestSamples {
    stats::TKind kind;
    std::vector<double> x;
    std::vector<double> y;
};

TestSamples samplesOf(const AnalysisRequest& request)
{
    const auto kind = choiceOr(request.inputs, "kind", kinds, "");
    if (kind == stats::TKind::OneSample) return {kind, numbersAt(request.inputs, "x"), {}};
    return {kind, numbersAt(request.inputs, "x"), numbersAt(request.inputs, "y")};
}

ordered_json tTest(const AnalysisRequest& request)
{
    const TestSamples samples = samplesOf(request);
    const stats::TOptions options{numberOr(request.options, "mu", 0), tailOf(request), confidenceLevelOf(request.options)};
    const auto t = stats::tTest(samples.kind, samples.x, samples.y, options);
    if (!t.why.empty()) return degenerate(t.why);
    AnswerFields answer;
    answer.put("estimate", t.estimate).put("se", t.se).put("t", t.t).put("df", t.df).putProbability("p", t.p, t.logP);
    answer.put("log_p", t.logP).put("ci", t.ci);
    if (samples.kind != stats::TKind::Welch) answer.put("sd", t.sd);
    if (samples.kind == stats::TKind::OneSample || samples.kind == stats::TKind::Paired)
        answer.put("d_z", t.dZ).put("hedges_g_z", t.hedgesGz);
    if (samples.kind == stats::TKind::Paired) answer.put("d_av_lakens", t.dAvLakens);
    if (samples.kind == stats::TKind::Paired || samples.kind == stats::TKind::Welch) answer.put("d_av_rms", t.dAvRms);
    if (samples.kind == stats::TKind::Student) answer.put("d_s", t.dS).put("hedges_g_s", t.hedgesGs);
    return answer.json();
}

ordered_json tost(const AnalysisRequest& request)
{
    const TestSamples samples = samplesOf(request);
    const stats::EquivalenceOptions options{numberAt(request.options, "low"), numberAt(request.options, "high"),
                                            numberOr(request.options, "alpha", 0.05)};
    const auto t = stats::equivalenceTest(samples.kind, samples.x, samples.y, options);
    if (!t.why.empty()) return degenerate(t.why);
    AnswerFields answer;
    answer.put("estimate", t.estimate).put("se", t.se).put("df", t.df);
    answer.put("t_lower", t.tLower).putProbability("p_lower", t.pLower, t.logPLower);
    answer.put("t_upper", t.tUpper).putProbability("p_upper", t.pUpper, t.logPUpper);
    answer.putProbability("p_tost", t.p, t.logP).put("log_p_tost", t.logP).put("ci", t.ci);
    answer.put("nhst_t", t.tDifference).putProbability("nhst_p", t.pDifference, t.logPDifference);
    answer.putText("nhst_significant", t.different).putText("equivalent", t.equivalent).putText("verdict", t.verdict());
    return answer.json();
}

ordered_json wilcoxon(const AnalysisRequest& request)
{
    stats::WilcoxonOptions options;
    options.tail = tailOf(request);
    options.zeros = choiceOr(request.options, "zero_method", zeroMethods, "wilcox");
    options.arithmetic = choiceOr(request.options, "arithmetic", arithmetics, "double");
    const auto x = numbersAt(request.inputs, "x");
    const auto y = numbersOrNone(request.inputs, "y");
    const auto w = stats::wilcoxonSignedRank(x, y, options);
    if (!w.why.empty()) return degenerate(w.why);
    AnswerFields answer;
    answer.putCount("n_used", w.nUsed).putCount("n_zero", w.nZero).put("V", w.v);
    answer.putProbability("p_exact", w.pExact, w.logPExact).put("log_p_exact", w.logPExact);
    answer.put("z", w.z).put("p_normal", w.pNormal).put("z_cc", w.zCorrected).put("p_normal_cc", w.pNormalCorrected);
    answer.put("rank_biserial", w.rankBiserial).put("hodges_lehmann", w.hodgesLehmann);
    return answer.json();
}

ordered_json signFlip(const AnalysisRequest& request)
{
    const auto x = numbersAt(request.inputs, "x");
    const auto y = numbersOrNone(request.inputs, "y");
    const auto test = stats::signFlipTest(x, y, tailOf(request));
    if (!test.why.empty()) return degenerate(test.why);
    AnswerFields answer;
    answer.putCount("n", test.n).putCount("n_zero", test.nZero).put("estimate", test.meanDifference);
    return answer.putProbability("p", test.p, test.logP).put("log_p", test.logP).json();
}

constexpr double mostResamples = 1e7;  // 80 MB
constexpr double mostDraws = 1e9;      // resamples x values: some seconds

ordered_json bca(const AnalysisRequest& request)
{
    if (const std::string statistic = textOr(request.options, "statistic", "mean"); statistic != "mean")
        throw RequestFault("unknown statistic \"" + statistic + "\"; expected: mean");
    stats::BootstrapOptions options;
    const long long resamples = wholeOr(request.options, "n_resamples", 10000);
    if (resamples < 1) throw RequestFault("n_resamples must be at least 1");
    options.resamples = static_cast<std::size_t>(resamples);
    options.confidence = confidenceLevelOf(request.options);
    options.seed = static_cast<std::uint64_t>(wholeOr(request.options, "seed", 1));
    options.threads = static_cast<unsigned>(std::max(0LL, wholeOr(request.options, "threads", 0)));
    const auto x = numbersAt(request.inputs, "x");
    checkSize("resamples", static_cast<double>(options.resamples), mostResamples);
    checkSize("resamples x values", static_cast<double>(options.resamples) * static_cast<double>(x.size()), mostDraws);
    const auto b = stats::bcaBootstrapOfMean(x, options);
    if (!b.why.empty()) return degenerate(b.why);
    AnswerFields answer;
    answer.putCount("n", b.n).put("estimate", b.estimate).put("se", b.standardError).put("z0", b.bias);
    return answer.put("acceleration", b.acceleration).put("ci", b.ci).json();
}

ordered_json jzs(const AnalysisRequest& request)
{
    const auto bf = stats::jzsBayesFactor(numberAt(request.inputs, "t"), wholeAt(request.inputs, "n"),
                                          numberOr(request.options, "r", stats::mediumPriorWidth));
    if (!bf.why.empty()) return degenerate(bf.why);
    AnswerFields answer;
    return answer.put("bf10", bf.bf10).put("log_bf10", bf.logBf10).json();
}

}  // namespace

std::vector<NamedAnalysis> analysesOfMeans()
{
    return {
        {"t_test", tTest, "kind x [y]", "[mu] [alternative] [conf_level]", "t test: one_sample, paired, student or welch"},
        {"tost", tost, "kind x [y]", "low high [alpha]", "two one-sided t tests of equivalence"},
        {"sign_flip", signFlip, "x [y]", "[alternative]", "exact test by flipping the signs of differences"},
        {"wilcoxon_signed_rank", wilcoxon, "x [y]", "[alternative] [zero_method] [arithmetic]", "exact signed-rank test"},
        {"bca_bootstrap_mean", bca, "x", "[statistic] [n_resamples] [conf_level] [seed] [threads]", "BCa interval of a mean"},
        {"jzs_bf10_one_sample", jzs, "t n", "[r]", "Bayes factor of a one-sample or paired t"},
    };
}

}  // namespace study::analyse
