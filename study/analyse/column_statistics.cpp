#include "study/analyse/column_statistics.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "stats/kernels/descriptive.h"
#include "stats/tests/equivalence.h"
#include "stats/tests/t_tests.h"
#include "stats/tests/wilcoxon.h"
#include "study/analyse/csv_column.h"
#include "study/analyse/statistic_json.h"

namespace study::analyse {

namespace {

using nlohmann::ordered_json;

constexpr double alpha = 0.05;  ///< level of the verdict "equivalent"

const char* nameOf(ColumnTest test)
{
    switch (test) {
        case ColumnTest::Paired:
            return "paired";
        case ColumnTest::Welch:
            return "welch";
        case ColumnTest::Student:
            return "student";
        case ColumnTest::Equivalence:
            return "tost";
        case ColumnTest::Wilcoxon:
            return "wilcoxon";
    }
    return "";
}

void putEffect(ordered_json& json, const char* name, const stats::Value& value)
{
    ordered_json effect{{"name", name}};
    put(effect, "value", value);
    json["effect"] = effect;
}

/// A decimal logarithm from a natural one.
stats::Value log10Of(const stats::Value& logarithm)
{
    return logarithm.exists() ? stats::Value(*logarithm / std::log(10.0)) : logarithm;
}

/// The t interval of a mean difference. One-sided, it ends on one side only.
void putInterval(ordered_json& json, const stats::Interval& interval, stats::Tail tail)
{
    put(json, "ci95", interval);
    if (tail == stats::Tail::TwoSided || json["ci95"].is_null()) return;
    const bool isLess = tail == stats::Tail::Less;
    json["ci95"][isLess ? 0 : 1] = nullptr;
    json["why"]["ci95"] = isLess ? "one-sided: no lower bound" : "one-sided: no upper bound";
}

void putTTest(ordered_json& json, const ColumnComparison& comparison, const std::vector<double>& a, const std::vector<double>& b)
{
    stats::TOptions options;
    options.tail = comparison.tail;
    const bool isPaired = comparison.test == ColumnTest::Paired;
    const auto test = isPaired                                 ? stats::pairedTTest(a, b, options)
                      : comparison.test == ColumnTest::Student ? stats::studentTTest(a, b, options)
                                                               : stats::welchTTest(a, b, options);
    json["n"] = isPaired ? ordered_json(test.n) : ordered_json{test.n, test.nSecond};
    put(json, "statistic", test.t);
    put(json, "df", test.df);
    put(json, "p", test.p);
    put(json, "log10_p", test.log10P());
    put(json, "mean_difference", test.estimate);
    putInterval(json, test.ci, comparison.tail);
    putEffect(json, isPaired ? "d_z" : "g", isPaired ? test.dZ : test.hedgesGs);
}

void putEquivalence(ordered_json& json, const ColumnComparison& comparison, const std::vector<double>& a,
                    const std::vector<double>& b)
{
    const auto [low, high] = comparison.bounds;
    const auto test = stats::equivalenceTest(stats::TKind::Paired, a, b, {low, high, alpha});
    const auto difference = stats::pairedTTest(a, b);
    json["n"] = test.n;
    // The test with the larger p decides, so its t is the statistic of the pair.
    const bool lowerDecides = test.pLower.orElse(0) >= test.pUpper.orElse(0);
    put(json, "statistic", lowerDecides ? test.tLower : test.tUpper);
    put(json, "df", test.df);
    put(json, "p", test.p);
    put(json, "log10_p", log10Of(test.logP));
    put(json, "mean_difference", test.estimate);
    put(json, "ci95", difference.ci);
    putEffect(json, "d_z", test.dZ);
    json["bounds"] = {low, high};
    put(json, "p_lower", test.pLower);
    put(json, "p_upper", test.pUpper);
    put(json, "ci90", test.ci);
    json["equivalent"] = test.why.empty() ? ordered_json(test.equivalent) : ordered_json();
    if (!test.why.empty()) json["why"]["equivalent"] = test.why;
    json["verdict"] = test.verdict();
}

stats::Value log10OfP(const stats::WilcoxonTest& test)
{
    if (test.pExact.exists()) return log10Of(test.logPExact);
    if (test.pNormalCorrected.exists() && *test.pNormalCorrected > 0) return std::log10(*test.pNormalCorrected);
    return stats::Value::undefined(test.why);
}

void putWilcoxon(ordered_json& json, const ColumnComparison& comparison, const std::vector<double>& a,
                 const std::vector<double>& b)
{
    stats::WilcoxonOptions options;
    options.tail = comparison.tail;
    const auto test = stats::wilcoxonSignedRank(a, b, options);
    stats::TOptions ofMeans;
    ofMeans.tail = comparison.tail;
    const auto difference = stats::pairedTTest(a, b, ofMeans);
    json["n"] = test.nUsed + test.nZero;
    put(json, "statistic", test.v);
    json["df"] = nullptr;
    json["why"]["df"] = "the signed-rank statistic has no degrees of freedom";
    const bool isExact = test.pExact.exists();
    put(json, "p", isExact ? test.pExact : test.pNormalCorrected);
    if (isExact || test.pNormalCorrected.exists())
        json["p_is"] = isExact ? "exact" : "normal approximation with continuity correction";
    put(json, "log10_p", log10OfP(test));
    put(json, "mean_difference", difference.estimate);
    putInterval(json, difference.ci, comparison.tail);
    putEffect(json, "rank_biserial", test.rankBiserial);
}

}  // namespace

ordered_json describeColumn(const std::vector<double>& values)
{
    const auto d = stats::describe(values);
    ordered_json json{{"schema", "vis2hap.describe/1"}, {"n", d.n}, {"missing", d.missing}};
    put(json, "mean", d.mean);
    put(json, "sd", d.sd);
    put(json, "variance", d.variance);
    put(json, "autocorrelation_lag1", d.autocorrelationLag1);
    put(json, "median", d.median);
    put(json, "q1", d.q1);
    put(json, "q3", d.q3);
    put(json, "min", d.min);
    put(json, "max", d.max);
    put(json, "ci95", d.ci95);
    return json;
}

ordered_json compareColumns(const ColumnComparison& comparison, const std::vector<double>& a, const std::vector<double>& b)
{
    const bool isPaired = comparison.test != ColumnTest::Welch && comparison.test != ColumnTest::Student;
    const auto pairs = completePairs(a, b);
    const auto x = isPaired ? pairs.a : present(a), y = isPaired ? pairs.b : present(b);
    ordered_json json{{"schema", "vis2hap.compare/1"}, {"test", nameOf(comparison.test)}};
    if (comparison.test == ColumnTest::Equivalence)
        putEquivalence(json, comparison, x, y);
    else if (comparison.test == ColumnTest::Wilcoxon)
        putWilcoxon(json, comparison, x, y);
    else
        putTTest(json, comparison, x, y);
    json["missing"] = isPaired ? pairs.missing : a.size() - x.size() + b.size() - y.size();
    return json;
}

}  // namespace study::analyse
