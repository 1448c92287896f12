#include "study/bench/extremes/extreme_samples.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "stats/kernels/descriptive.h"
#include "stats/kernels/distributions.h"
#include "stats/metrics/trace_error.h"
#include "stats/models/crossed_study.h"
#include "stats/tests/binomial.h"
#include "stats/tests/bootstrap.h"
#include "stats/tests/equivalence.h"
#include "stats/tests/forced_choice.h"
#include "stats/tests/intraclass.h"
#include "stats/tests/mcnemar.h"
#include "stats/tests/one_way_anova.h"
#include "stats/tests/rank_tests.h"
#include "stats/tests/repeated_measures.h"
#include "stats/tests/sign_flip.h"
#include "stats/tests/wilcoxon.h"

namespace study::bench {

namespace {

using Numbers = std::vector<double>;
using Cases = std::vector<ExtremeCase>;

const double denormal = std::numeric_limits<double>::denorm_min();
const double notANumber = std::numeric_limits<double>::quiet_NaN();
const double infinity = std::numeric_limits<double>::infinity();

const char* exact = "exact rational arithmetic on the doubles of the input";
const char* noNumber = "no such number exists";

Numbers scaled(Numbers x, int exponent)
{
    for (double& value : x) value = std::ldexp(value, exponent);
    return x;
}

ExtremeCase sampleCase(std::string input, std::string asked, std::string truth, std::string source, double digits,
                       std::function<stats::Value()> ours, PeerRequest peer = {})
{
    return {"statistics",
            std::move(input),
            std::move(asked),
            std::move(truth),
            std::move(source),
            digits,
            [ours = std::move(ours)] { return answerOf(ours()); },
            std::move(peer)};
}

/// A one-sample t test against `mu`.
ExtremeCase tCase(const std::string& input, const Numbers& x, double mu, const std::string& truth, const std::string& source,
                  double digits = 14)
{
    return sampleCase(input, "t", truth, source, digits, [=] { return stats::oneSampleTTest(x, {.mu = mu}).t; },
                      {"one sample t", {x, {mu}}});
}

ExtremeCase pCase(const std::string& input, const Numbers& x, double mu, const std::string& truth, const std::string& source,
                  double digits = 14)
{
    return sampleCase(input, "p", truth, source, digits, [=] { return stats::oneSampleTTest(x, {.mu = mu}).p; },
                      {"one sample p", {x, {mu}}});
}

void addScales(Cases& cases)
{
    for (const int exponent : {600, -600}) {
        const std::string input = "{1, 2} x 2^" + std::to_string(exponent);
        cases.push_back(tCase(input, scaled({1, 2}, exponent), 0, "3", "mean 1.5, standard error 0.5", 16));
        cases.push_back(pCase(input, scaled({1, 2}, exponent), 0, "0.20483276469913345", "Cauchy: 1 - 2 atan(3)/pi"));
    }
    const Numbers tiny{denormal, 2 * denormal, 3 * denormal};
    cases.push_back(tCase("{1, 2, 3} x 5e-324", tiny, 0, "3.4641016151377546", "2 sqrt(3)"));
    cases.push_back(pCase("{1, 2, 3} x 5e-324", tiny, 0, "0.074179900227448538", "2 degrees of freedom: 1 - sqrt(6/7)", 13));
    const Numbers large{1e308, 1.2e308, 1.5e308};
    cases.push_back(tCase("{1, 1.2, 1.5} x 1e308", large, 0, "8.488382153210785", exact));
    cases.push_back(sampleCase("{1, 1.2, 1.5} x 1e308", "mean", "1.2333333333333333e+308", exact, 15,
                               [=] { return stats::oneSampleTTest(large).estimate; }, {"mean", {large}}));
    cases.push_back(sampleCase("{1, 1.2, 1.5} x 1e308", "upper end of the 95 % interval", "1.8584942812709111e+308",
                               "2 degrees of freedom: quantile in closed form; beyond double", 11,
                               [=] { return stats::oneSampleTTest(large).ci.high; }, {"one sample high", {large, {0}}}));
    cases.push_back(sampleCase("{1e200, 3e200}", "variance", "1.9999999999999999e+400", std::string(exact) + "; beyond double",
                               12,
                               [] {
                                   return stats::describe(Numbers{1e200, 3e200}).variance;
                               },
                               {"variance", {{1e200, 3e200}}}));
    cases.push_back(sampleCase("{1e308, -1e308} against the negative", "mean absolute error", "2e+308", "exact; beyond double",
                               12,
                               [] {
                                   return stats::traceError(Numbers{1e308, -1e308}, Numbers{-1e308, 1e308}).mae;
                               },
                               {"mean absolute error", {{1e308, -1e308}, {-1e308, 1e308}}}));
}

Numbers alternating(double first, double low, double high)
{
    Numbers x{first};
    for (int i = 0; i < 500; ++i) {
        x.push_back(low);
        x.push_back(high);
    }
    return x;
}

void addOffsets(Cases& cases)
{
    cases.push_back(tCase("1e15 + {1, 2, 3, 5, 8} against 1e15", {1e15 + 1, 1e15 + 2, 1e15 + 3, 1e15 + 5, 1e15 + 8}, 1e15,
                          "3.0621272632964451", "3.8/sqrt(7.7/5)"));
    cases.push_back(tCase("1e16 + {2, 4, 6, 10} against 1e16", {1e16 + 2, 1e16 + 4, 1e16 + 6, 1e16 + 10}, 1e16,
                          "3.2204702407301595", "5.5/sqrt(35/12)"));
    const std::string source = std::string("NIST's recipe, ") + exact;
    struct Recipe {
        const char* name;
        Numbers x;
        const char *sd, *lag;
    };
    for (const auto& [name, x, sd, lag] : std::vector<Recipe>{
             {"NumAcc1", {10000001, 10000003, 10000002}, "1", "-0.5"},
             {"NumAcc2", alternating(1.2, 1.1, 1.3), "0.099999999999999978", "-0.999"},
             {"NumAcc3", alternating(1000000.2, 1000000.1, 1000000.3), "0.1000000000349246", "-0.9989999999994185"},
             {"NumAcc4", alternating(10000000.2, 10000000.1, 10000000.3), "0.10000000055879354", "-0.99899999999069608"}}) {
        const Numbers sample = x;
        cases.push_back(sampleCase(name, "standard deviation", sd, source, 14, [=] { return stats::describe(sample).sd; },
                                   {"standard deviation", {sample}}));
        if (std::string(name) != "NumAcc1")
            cases.push_back(sampleCase(name, "lag-1 autocorrelation", lag, source, 14,
                                       [=] { return stats::describe(sample).autocorrelationLag1; },
                                       {"autocorrelation", {sample}}));
    }
    Numbers heaps(10000);
    for (std::size_t i = 0; i < heaps.size(); ++i) heaps[i] = (i < 5000 ? 0 : 1e9) + (i % 2 == 0 ? -1 : 1);
    cases.push_back(sampleCase("5,000 values about 0 and 5,000 about 1e9, each +-1", "variance", "2.5002500250025003e+17",
                               "10000 (1 + 0.25e18)/9999", 15, [=] { return stats::describe(heaps).variance; },
                               {"variance", {heaps}}));
}

/// SmLs: nine treatments; the first value is offset + c, then offset + c - 0.1 and offset + c + 0.1 alternate.
std::vector<Numbers> simonLesage(double offset, int replicates)
{
    std::vector<Numbers> groups;
    for (const int tenths : {4, 3, 5, 3, 5, 3, 5, 3, 5}) {
        Numbers group{(10 * offset + tenths) / 10};
        for (int i = 1; i < replicates; i += 2) {
            group.push_back((10 * offset + tenths - 1) / 10);
            group.push_back((10 * offset + tenths + 1) / 10);
        }
        groups.push_back(group);
    }
    return groups;
}

void addAnova(Cases& cases)
{
    struct Recipe {
        const char* name;
        double offset;
        int replicates;
        const char* f;
    };
    for (const Recipe& one : {Recipe{"SmLs01", 1, 21, "21.000000000000001"}, Recipe{"SmLs02", 1, 201, "201.00000000000002"},
                              Recipe{"SmLs03", 1, 2001, "2001.0000000000002"}, Recipe{"SmLs04", 1e6, 21, "21.000000000776102"},
                              Recipe{"SmLs05", 1e6, 201, "201.00000001241763"}, Recipe{"SmLs06", 1e6, 2001, "2001.000000128833"},
                              Recipe{"SmLs07", 1e12, 21, "21.000811887818771"}, Recipe{"SmLs08", 1e12, 201, "201.01300409594845"},
                              Recipe{"SmLs09", 1e12, 2001, "2001.1349262209505"}}) {
        const auto groups = simonLesage(one.offset, one.replicates);
        cases.push_back(sampleCase(one.name, "F", one.f, std::string("NIST's recipe, ") + exact, 13,
                                   [=] { return stats::oneWayAnova(groups).f; }, {"anova F", groups}));
    }
    for (const int exponent : {1000, -1000}) {
        std::vector<Numbers> rows{{1, 2, 4}, {2, 2, 3}, {1, 3, 5}, {3, 3, 4}};
        for (Numbers& row : rows) row = scaled(row, exponent);
        cases.push_back(sampleCase(
            "4 x 3 table x 2^" + std::to_string(exponent), "F of repeated measures", "9", "exact rational arithmetic", 14,
            [=] { return stats::repeatedMeasuresAnova(stats::blockTableOf(rows).table).f; }, {"repeated measures F", rows}));
    }
}

void addTails(Cases& cases)
{
    cases.push_back(sampleCase("t = 1e200, 2 degrees of freedom", "log p", "-921.03403719761827361",
                               "1 - t/sqrt(2 + t^2) with 500 digits", 14,
                               [] { return stats::Value(stats::studentTwoSided(1e200, 2).logP); }, {"log p of t", {{1e200, 2}}}));
    cases.push_back(sampleCase("t = 1e-9, 1 degree of freedom", "log p", "-6.3661977257022375e-10", "Cauchy: 1 - 2 atan(t)/pi", 8,
                               [] { return stats::Value(stats::studentTwoSided(1e-9, 1).logP); }, {"log p of t", {{1e-9, 1}}}));
    cases.push_back(sampleCase("5,000 of 5,000 at chance 1/3", "log p", "-5493.0614433405485", "-5000 log 3", 14,
                               [] { return stats::binomialTest(5000, 5000, 1.0 / 3).logPGreater; },
                               {"log p of count", {{5000, 5000, 1.0 / 3}}}));
    cases.push_back(sampleCase("0 of 70", "upper end of Clopper and Pearson", "0.051333797151023759", "1 - 0.025^(1/70)", 13,
                               [] { return stats::clopperPearsonInterval(0, 70).high; }, {"clopper high", {{0, 70}}}));
    cases.push_back(sampleCase("0 of 1,000,000,000", "upper end of Clopper and Pearson", "3.6888794473100205e-9",
                               "1 - 0.025^(1e-9) with 60 digits", 9,
                               [] { return stats::clopperPearsonInterval(0, 1000000000).high; }, {"clopper high", {{0, 1e9}}}));
    cases.push_back(
        sampleCase("ratings 0.3 0.9 0.7 0.1 against 0.2 0.8 0.6 0.2", "p of Wilcoxon, exact", "0.625",
                   "10 of 16 signs of four tied differences of 0.1", 15,
                   [] {
                       return stats::wilcoxonSignedRank(Numbers{0.3, 0.9, 0.7, 0.1}, Numbers{0.2, 0.8, 0.6, 0.2}).pExact;
                   },
                   {"wilcoxon p", {{0.3, 0.9, 0.7, 0.1}, {0.2, 0.8, 0.6, 0.2}}}));
    cases.push_back(sampleCase("one difference", "p of sign flips", "1", "both signs are equally far from 0", 16,
                               [] { return stats::signFlipTest(Numbers{3}, {}).p; }));
    cases.push_back(sampleCase("no discordant pair", "p of McNemar, exact", "1", "nothing speaks for a difference", 16,
                               [] { return stats::mcnemarTest(0, 0).pExact; }));
}

void addBounds(Cases& cases)
{
    for (const bool upper : {true, false}) {
        const Numbers x = upper ? Numbers{0.25, 0.75} : Numbers{-0.25, -0.75};
        cases.push_back(sampleCase(upper ? "mean at the upper bound 0.5" : "mean at the lower bound -0.5", "p of equivalence",
                                   "0.5", "t of one of the two tests is 0", 15,
                                   [=] { return stats::equivalenceTest(stats::TKind::OneSample, x, {}).p; },
                                   {"tost p", {x, {-0.5, 0.5}}}));
    }
    cases.push_back(sampleCase("{0, 0, 0, 0} within -0.5 to 0.5", "p of equivalence", "refused", noNumber, 0,
                               [] { return stats::equivalenceTest(stats::TKind::OneSample, Numbers(4, 0.0), {}).p; },
                               {"tost p", {Numbers(4, 0.0), {-0.5, 0.5}}}));
}

void addRefusals(Cases& cases)
{
    const Numbers same(10, 0.1);
    cases.push_back(pCase("ten times 0.1 against 0.1", same, 0.1, "refused", noNumber, 0));
    cases.push_back(pCase("no values", {}, 0, "refused", noNumber, 0));
    cases.push_back(pCase("one value", {3}, 0, "refused", noNumber, 0));
    cases.push_back(pCase("{1, 2, infinity}", {1, 2, infinity}, 0, "refused", noNumber, 0));
    cases.push_back(pCase("{1, 2, NaN}", {1, 2, notANumber}, 0, "refused", "a missing value is left out on request only", 0));
    cases.push_back(sampleCase("ten times 0.1", "BCa interval", "refused", noNumber, 0,
                               [=] { return stats::bcaBootstrapOfMean(same).ci.low; }, {"bca low", {same}}));
    cases.push_back(sampleCase("two constant groups", "F", "refused", noNumber, 0,
                               [=] {
                                   return stats::oneWayAnova({same, Numbers(3, 0.7)}).f;
                               },
                               {"anova F", {same, Numbers(3, 0.7)}}));
    const std::vector<Numbers> flat{{0.1, 0.1}, {0.1, 0.1}, {0.1, 0.1}};
    const auto table = stats::blockTableOf(flat).table;
    cases.push_back(sampleCase("a constant table", "Friedman's Q", "refused", noNumber, 0,
                               [=] { return stats::friedmanTest(table).q; },
                               {"friedman q", {{0.1, 0.1, 0.1}, {0.1, 0.1, 0.1}, {0.1, 0.1, 0.1}}}));
    cases.push_back(sampleCase("a constant table", "ICC(2,1)", "refused", noNumber, 0,
                               [=] { return stats::intraclassCorrelations(table).icc2; }));
    cases.push_back(sampleCase("0 of 0", "p at chance 1/3", "refused", noNumber, 0,
                               [] { return stats::binomialTest(0, 0, 1.0 / 3).pGreater; }, {"p of count", {{0, 0, 1.0 / 3}}}));
    cases.push_back(sampleCase("a condition whose choices are all right", "log odds", "refused", "separation: no maximum", 0, [] {
        stats::CrossedStudy study;
        std::vector<std::string> people, fabrics, conditions;
        for (int p = 0; p < 4; ++p)
            for (int f = 0; f < 3; ++f)
                for (int c = 0; c < 2; ++c) {
                    people.push_back(std::to_string(p));
                    fabrics.push_back(std::to_string(f));
                    conditions.push_back(c == 0 ? "a" : "b");
                    study.values.push_back(c == 1 || (p + f) % 2 == 0 ? 1 : 0);
                }
        study.participant = stats::factorOf("p", people);
        study.fabric = stats::factorOf("f", fabrics);
        study.condition = stats::factorOf("c", conditions);
        const auto fitted = stats::fitChoices(study).model;
        return fitted.fixed.size() > 1 ? fitted.fixed[1].estimate : stats::Value::undefined(fitted.why);
    }));
}

}  // namespace

Cases extremeSamples()
{
    Cases cases;
    for (const auto add : {addScales, addOffsets, addAnova, addTails, addBounds, addRefusals}) add(cases);
    return cases;
}

}  // namespace study::bench
